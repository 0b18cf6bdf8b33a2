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
  int error = 0;  ///< errno; 0: the program runs
};

/// Starts a program, searched in PATH, as a child in its own session, with the standard input as
/// its controlling terminal if it is a terminal. No signals are blocked or ignored. The kernel
/// kills the child if this process ends (PR_SET_PDEATHSIG). `argv` ends with a null pointer.
/// `listening_socket`, unless −1, becomes its descriptor 3, as by sd_listen_fds(3).
ProgramStart start_program(char* const* argv, int listening_socket = -1);

struct WatchOptions {
  int stop_signal = SIGINT;     ///< for descendants left when the program ends
  double stop_time_s = 7.0;     ///< from stop_signal to SIGKILL
  char* const* argv = nullptr;  ///< program and arguments
};

/// Runs a program and waits until it and all its descendants, at any depth and in any session, have
/// ended. Orphaned descendants become children of this process (PR_SET_CHILD_SUBREAPER). Signals
/// received from the supervisor are forwarded to all descendants. When the connection closes,
/// because the supervisor has ended for any reason, all are killed.
class Watch {
 public:
  explicit Watch(const WatchOptions& options);

  /// Returns when all descendants have ended.
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
