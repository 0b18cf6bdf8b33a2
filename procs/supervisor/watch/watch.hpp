// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <cstdint>
#include <optional>

#include <sys/types.h>

#include "procs/supervisor/watch/program_start.hpp"
#include "procs/supervisor/watch/watch_protocol.hpp"

namespace adit {

struct WatchOptions {
  int stop_signal = SIGINT;     ///< for what the program leaves behind when it ends
  double stop_time_s = 7.0;     ///< from there to SIGKILL
  char* const* argv = nullptr;  ///< of the program
};

/// Runs a program and stays until it and everything that it started, at whatever depth and in
/// whatever session, is gone. Whoever loses its parent among these becomes a child of this process
/// (PR_SET_CHILD_SUBREAPER), so that nobody gets away. Signals that come over the line go to all of
/// them. When the line closes, because the supervisor is gone, however it went, all are killed.
class Watch {
 public:
  explicit Watch(const WatchOptions& options);

  /// Returns when nothing is left.
  void run();

 private:
  void report(WatchReport::Kind kind, int number) const;
  void reap();
  void take_signals();
  void send_to_all(int signal) const;
  [[nodiscard]] int timeout_ms() const;

  WatchOptions options_;
  int child_signals_;
  bool killing_ = false;
  bool anybody_left_ = true;
  std::optional<std::int64_t> kill_at_us_;
  ProgramStart program_;
};

}  // namespace adit
