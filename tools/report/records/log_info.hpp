// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/config.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// What there is in the logs of a mission, before any of it is looked at closely.
struct LogInfo {
  std::map<std::string, std::size_t, std::less<>> messages;  ///< by channel
  std::int64_t first_utime = 0;                              ///< of the recording
  std::int64_t last_utime = 0;
  std::map<std::string, ConfigSnapshot> configs;  ///< the last of each stage
  std::vector<std::string> warnings;              ///< of the files, a sentence each

  [[nodiscard]] bool has(std::string_view channel) const {
    return messages.find(channel) != messages.end();
  }
  [[nodiscard]] double duration_s() const {
    return 1e-6 * static_cast<double>(last_utime - first_utime);
  }
  /// Whether a simulator made the measurements.
  [[nodiscard]] bool simulated() const;
  /// Where the lasers were, by the first stage that says it; defaults without.
  [[nodiscard]] Lasers lasers() const;
};

/// The parameters with which a stage ran, by its CONFIG; defaults where there is none, or one that
/// another version wrote and this one does not understand.
template <class Params>
Params recorded_params(const LogInfo& log_info, const std::string& stage) {
  const auto copy = log_info.configs.find(stage);
  if (copy == log_info.configs.end()) return {};
  try {
    return load_section<Params>(ConfigFile::parse(copy->second.yaml, "CONFIG of " + stage), stage);
  } catch (const ConfigError&) {
    return {};
  }
}

/// Goes through the logs once. Throws std::runtime_error where one cannot be read, or there is no
/// event in any.
LogInfo read_log_info(const std::vector<std::filesystem::path>& logs);

}  // namespace adit
