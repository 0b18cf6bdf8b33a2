// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// A recording of either kind, ready to be replayed.
class LogInput {
 public:
  /// Opens an LCM log as it is, and a CARMEN log (plain or gzip) by way of an LCM log in `scratch`,
  /// so that both take the same way from there on. `progress` is called while a CARMEN log is read.
  /// Throws std::runtime_error where the file cannot be used.
  LogInput(const std::filesystem::path& path, const std::filesystem::path& scratch,
           const std::function<void(double)>& progress);

  [[nodiscard]] EventSource& events() { return *log_; }
  /// All events, whatever has been taken from `events()` already.
  [[nodiscard]] std::span<const LogEventView> all_events() const { return log_->events(); }
  /// What was wrong with the recording and has been skipped, a sentence each.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> warnings_;
  std::unique_ptr<LogFile> log_;
};

/// Where the lasers were by the first configuration on record (channel CONFIG) that says it: a log
/// explains itself. Nothing where none does. Throws ConfigError where it cannot be understood.
std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events);

}  // namespace adit
