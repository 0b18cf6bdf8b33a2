// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/bus/event_source.hpp"

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
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;
  std::unique_ptr<LogFile> log_;
};

}  // namespace adit
