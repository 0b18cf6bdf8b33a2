// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/memory_bus.hpp"

namespace adit {

/// Plays logs to a bus, one after the other, each in the order in which it was written; channels
/// that are not wanted are passed over. Nothing of a log is kept. `progress` is called with the
/// share that is done. Throws std::runtime_error where a file cannot be read.
void play_logs(const std::vector<std::filesystem::path>& logs,
               const std::set<std::string, std::less<>>& wanted, MemoryBus& bus,
               const std::function<void(double)>& progress);

}  // namespace adit
