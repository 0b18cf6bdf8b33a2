// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <sys/types.h>

#include "common/process_list/command_line.hpp"
#include "procs/supervisor/os/file_descriptor.hpp"
#include "procs/supervisor/watch/watch_protocol.hpp"

namespace adit {

struct ChildStart {
  CommandLine line;
  int stop_signal = 0;  ///< for descendants left when the program ends
  double stop_time_s = 0.0;
  std::filesystem::path watcher = {};  ///< path of adit-watch; its folder is appended to PATH
  /// A socket that the program inherits, as by sd_listen_fds(3).
  std::optional<int> listening_socket = {};
  /// Takes standard output and standard error, in place of a terminal; the input is then empty.
  std::optional<int> output = {};
  std::filesystem::path folder = {};  ///< working folder; empty: that of this process
};

/// A running program with all its descendants, under its own adit-watch (see Watch), which tracks
/// all descendants and kills them if this process ends. The program has a pseudo terminal for input
/// and output unless ChildStart::output is set, its own session, and inherits no other file
/// descriptors but a listening socket.
class ChildProcess {
 public:
  /// How a program ended.
  struct End {
    int wait_status = 0;
    double cpu_s = 0.0;             ///< of the program and all its descendants
    std::int64_t memory_bytes = 0;  ///< the largest resident set of one of them, or of this process

    [[nodiscard]] bool succeeded() const { return wait_status == 0; }
    /// "ended with exit code 3", "killed by SIGSEGV".
    [[nodiscard]] std::string text() const;
  };

  /// Returns when the program runs. Throws std::runtime_error if it cannot be started.
  explicit ChildProcess(const ChildStart& start);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads the reports of adit-watch without blocking. Returns the end of the program once, when
  /// all its descendants have ended too.
  std::optional<End> poll();

  /// Reads output without blocking, until about `bytes_max` bytes.
  std::string read_output(std::size_t bytes_max) const;

  /// Sends a signal to the program and all its descendants. SIGKILL is repeated until all have
  /// ended.
  void send(int signal) const;

  /// Whether the program itself has ended; descendants may still run.
  [[nodiscard]] bool program_has_ended() const { return end_.has_value(); }
  /// Process id of adit-watch, the ancestor of all processes.
  [[nodiscard]] pid_t watcher() const { return watcher_; }
  /// Process id of the program.
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  void wait_for_start();
  void read_reports();

  FileDescriptor terminal_;  // none with an output of its own
  FileDescriptor reports_;
  FileDescriptor signals_;
  pid_t watcher_ = -1;
  pid_t pid_ = -1;
  std::optional<End> end_;
};

}  // namespace adit
