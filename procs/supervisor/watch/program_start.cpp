// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/watch/program_start.hpp"

#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr int kCouldNotRun = 127;  // as shells say it

void forget_signals() {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void become(char* const* argv, pid_t parent, int report) {
  forget_signals();
  setsid();
  ioctl(STDIN_FILENO, TIOCSCTTY, 0);  // fails where there is no terminal, and need not succeed
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() == parent) execvp(argv[0], argv);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(report, &error, sizeof(error));
  _exit(kCouldNotRun);
}

}  // namespace

ProgramStart start_program(char* const* argv) {
  int report[2];  // closes when the program takes over
  if (pipe2(report, O_CLOEXEC) != 0) return {-1, errno};
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(argv, parent, report[1]);
  ProgramStart start{pid, pid < 0 ? errno : 0};
  close(report[1]);
  int error = 0;
  if (read(report[0], &error, sizeof(error)) == sizeof(error)) start.error = error;
  close(report[0]);
  if (pid > 0 && start.error != 0) waitpid(pid, nullptr, 0);
  return start;
}

}  // namespace adit
