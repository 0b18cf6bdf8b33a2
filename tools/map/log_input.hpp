// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"

namespace adit {

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

}  // namespace adit
