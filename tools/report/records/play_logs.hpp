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

/// Names of channels.
using ChannelSet = std::set<std::string, std::less<>>;

/// Replays the selected channels of logs, one log after the other, each in its order; `progress`
/// gets the share that is read, `after_event` is called after each event. Throws std::runtime_error
/// for a file that cannot be read.
void play_logs(const std::vector<std::filesystem::path>& logs, const ChannelSet& selected,
               MemoryBus& bus, const std::function<void(double)>& progress,
               const std::function<void()>& after_event);

}  // namespace adit
