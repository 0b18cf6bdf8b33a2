// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/bus/log/lcm_log.hpp"
#include "common/files/disk_space.hpp"

namespace adit {

/// The recording of a run in an LCM log, of which the disk is needed more for other files: it
/// stops, with a readable log, when the space becomes short or the disk fails, and the run
/// continues.
class Recording {
 public:
  /// Name of the recorder in its heartbeats, and among the stages that a simulator waits for.
  static constexpr const char* kStage = "record";

  /// Stops below `free_min_mb` on the disk of the log. Throws FileError if the log cannot be
  /// created.
  Recording(const std::filesystem::path& path, double free_min_mb);

  /// Records an event, unless the recording has stopped.
  void write(const LogEventView& event);

  /// Looks at the free space; call it about once a second. `utime` is the time of the log [µs since
  /// the epoch]. When the recording stops for want of space, its last event is a HEARTBEAT with the
  /// reason.
  void check_space(std::int64_t utime);

  /// Flushes and closes the log.
  void close();

  /// Why the recording has stopped, in one line; empty while it runs.
  [[nodiscard]] const std::string& stopped() const { return stopped_; }

  /// The HEARTBEAT that says so.
  [[nodiscard]] LogEvent heartbeat(std::int64_t utime) const;

 private:
  void stop(const std::string& reason);

  std::optional<LogWriter> log_;  ///< empty once stopped
  DiskSpace space_;
  std::string stopped_;
};

}  // namespace adit
