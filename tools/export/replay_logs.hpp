// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/bus/log/lcm_log.hpp"

namespace adit {

/// Passes all events of the logs, one log after the other, to `play`, and the share that is done,
/// from 0 to 1, to `progress`. Returns a sentence for each damage of the logs. Throws what reading
/// throws.
std::vector<std::string> replay_logs(const std::vector<std::filesystem::path>& logs,
                                     const std::function<void(double)>& progress,
                                     const std::function<void(const LogEventView&)>& play);

}  // namespace adit
