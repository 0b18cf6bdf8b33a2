// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages/diagnostics.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/map/log_input.hpp"

namespace adit {

/// Contents of the logs of a mission: channels, time span, configuration and damage.
struct LogInfo {
  std::map<std::string, std::size_t, std::less<>> messages;  ///< number of messages by channel
  std::int64_t first_utime = 0;
  std::int64_t last_utime = 0;
  std::map<std::string, ConfigSnapshot> configs;  ///< last CONFIG of each stage
  Lasers lasers;                      ///< of the first CONFIG that has them, or defaults
  std::vector<std::string> warnings;  ///< damage of the logs, one sentence each

  [[nodiscard]] bool has(std::string_view channel) const {
    return messages.find(channel) != messages.end();
  }
  /// True if the log has channels or a CONFIG of the simulator.
  [[nodiscard]] bool simulated() const;
};

/// Parameters of a stage from its recorded CONFIG; defaults if there is none. Defaults are also
/// used for a CONFIG that cannot be read (damaged, or of another version), with a warning.
template <class Params>
Params recorded_params(const LogInfo& log_info, const std::string& stage,
                       std::vector<std::string>& warnings) {
  const auto config = log_info.configs.find(stage);
  if (config == log_info.configs.end()) return {};
  return recorded_section<Params>(config->second, stage, warnings).value_or(Params{});
}

/// Reads the logs once. Throws std::runtime_error if a log cannot be read, or if no log has an
/// event.
LogInfo read_log_info(const std::vector<std::filesystem::path>& logs);

}  // namespace adit
