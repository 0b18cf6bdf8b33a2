// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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
  int stop_signal = 0;  ///< for what the program leaves behind when it ends by itself
  double stop_time_s = 0.0;
  std::filesystem::path watcher;  ///< adit-watch; its folder is the last in the program's PATH
};

/// A program that runs, with all that it starts: under an adit-watch of its own (see Watch), which
/// lets nobody get away and kills all when this process ends. The program has a pseudo terminal for
/// input and output, no other descriptor of ours, and a session of its own.
class ChildProcess {
 public:
  /// How a program ended.
  struct End {
    int wait_status = 0;

    [[nodiscard]] bool succeeded() const { return wait_status == 0; }
    /// "ended with exit code 3", "killed by SIGSEGV".
    [[nodiscard]] std::string text() const;
  };

  /// Returns when the program runs. Throws std::runtime_error where it cannot be started.
  explicit ChildProcess(const ChildStart& start);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Hears what happened, without waiting. Returns how it ended once nothing of it is left; that is
  /// the last thing it returns.
  std::optional<End> poll();

  /// What was printed since, without waiting; so many bytes at most.
  std::string read_output(std::size_t bytes_max) const;

  /// To the program and all that it started. SIGKILL leaves nobody.
  void send(int signal) const;

  /// Whether the program itself has ended; something that it started may be left.
  [[nodiscard]] bool program_has_ended() const { return end_.has_value(); }
  /// Of adit-watch: all processes descend from it.
  [[nodiscard]] pid_t watcher() const { return watcher_; }
  /// Of the program.
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  void wait_for_start();
  void read_reports();

  FileDescriptor terminal_;
  FileDescriptor reports_;
  FileDescriptor signals_;
  pid_t watcher_ = -1;
  pid_t pid_ = -1;
  std::optional<End> end_;
};

}  // namespace adit
