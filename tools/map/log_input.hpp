// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/config/config.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// Whether the file is an LCM log, by its first bytes or its extension.
bool is_lcm_log(const std::filesystem::path& file);

/// An LCM or CARMEN log for replay.
class LogInput {
 public:
  /// Opens an LCM log, or converts a CARMEN log (plain or gzip) to an LCM log in `scratch` first.
  /// `progress` is called during the conversion. Throws std::runtime_error for an unusable file.
  LogInput(const std::filesystem::path& path, const std::filesystem::path& scratch,
           const std::function<void(double)>& progress);

  [[nodiscard]] EventSource& events() { return *log_; }
  /// All events, independent of the read position of `events()`.
  [[nodiscard]] std::span<const LogEventView> all_events() const { return log_->events(); }
  /// Skipped parts of the log, without a verb: "12 corrupt bytes in 1 place".
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> warnings_;
  std::unique_ptr<LogFile> log_;
};

/// A section of a recorded CONFIG; nothing if it has no such section. A CONFIG that cannot be read
/// (damaged, or of another version) gives nothing and adds one warning per stage.
template <class Params>
std::optional<Params> recorded_section(const ConfigSnapshot& snapshot, const std::string& section,
                                       std::vector<std::string>& warnings) {
  try {
    const ConfigFile config =
        ConfigFile::parse(snapshot.yaml, fmt::format("CONFIG of {}", snapshot.stage));
    if (config.section(section) == nullptr) return std::nullopt;
    return load_section<Params>(config, section);
  } catch (const ConfigError& error) {
    const std::string warning = fmt::format("recorded {}; it is not used", error.what());
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
      warnings.push_back(warning);
    }
    return std::nullopt;
  }
}

/// Laser mounts of the first CONFIG in a log that has them; nothing if none has. An unreadable
/// CONFIG adds a warning.
std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events,
                                      std::vector<std::string>& warnings);

}  // namespace adit
