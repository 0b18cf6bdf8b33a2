// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <cstdint>
#include <optional>

#include <sys/types.h>

#include "procs/supervisor/watch/watch_protocol.hpp"

namespace adit {

struct ProgramStart {
  pid_t pid = -1;
  int error = 0;  ///< as errno; 0: the program runs
};

/// Runs a program, looked for in PATH, as a child in a session of its own, whose terminal is the
/// standard input where that is one; with no signal blocked or ignored, and killed by the kernel if
/// this process ends. `argv` ends with a null pointer.
ProgramStart start_program(char* const* argv);

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
  void forward_signals();
  void send_to_all(int signal) const;
  [[nodiscard]] int timeout_ms() const;

  WatchOptions options_;
  int child_signals_;
  bool killing_ = false;
  bool any_child_left_ = true;
  std::optional<std::int64_t> kill_at_us_;
  ProgramStart program_;
};

}  // namespace adit
