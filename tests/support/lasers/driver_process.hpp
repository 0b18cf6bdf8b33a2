// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace adit {

/// A program that runs beside the test; ended at the latest by the destructor.
class DriverProcess {
 public:
  /// Throws std::system_error if the program cannot be started.
  explicit DriverProcess(const std::vector<std::string>& command);
  ~DriverProcess();
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  [[nodiscard]] bool is_running();

  /// Processor time since its start, in user and kernel mode [s].
  [[nodiscard]] double cpu_s() const;

  /// As if the computer hung, and its end.
  void suspend() const;
  void resume() const;

  /// Sends SIGTERM and waits. Returns the exit code, −1 if a signal ended it.
  int terminate();

 private:
  pid_t pid_ = -1;
  int status_ = 0;
};

}  // namespace adit
