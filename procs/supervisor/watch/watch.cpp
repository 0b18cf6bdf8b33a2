// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/watch/watch.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/service/wall_time.hpp"
#include "procs/supervisor/os/procfs.hpp"

namespace adit {
namespace {

constexpr int kExecFailed = 127;  // exit code of shells

void reset_signals() {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// The convention of sd_listen_fds(3).
void pass_socket(int listening_socket) {
  constexpr int kFirstPassed = 3;
  setenv("LISTEN_FDS", "1", 1);
  setenv("LISTEN_PID", std::to_string(getpid()).c_str(), 1);
  dup2(listening_socket, kFirstPassed);  // without close-on-exec
}

[[noreturn]] void exec_program(char* const* argv, pid_t parent, int report, int listening_socket) {
  reset_signals();
  if (listening_socket >= 0) pass_socket(listening_socket);
  setsid();
  ioctl(STDIN_FILENO, TIOCSCTTY, 0);  // fails without a terminal, which is not an error
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() == parent) execvp(argv[0], argv);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(report, &error, sizeof(error));
  _exit(kExecFailed);
}

}  // namespace

ProgramStart start_program(char* const* argv, int listening_socket) {
  int report[2];  // closed by exec
  if (pipe2(report, O_CLOEXEC) != 0) return {-1, errno};
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) exec_program(argv, parent, report[1], listening_socket);
  ProgramStart start{pid, pid < 0 ? errno : 0};
  close(report[1]);
  int error = 0;
  if (read(report[0], &error, sizeof(error)) == sizeof(error)) start.error = error;
  close(report[0]);
  if (pid > 0 && start.error != 0) waitpid(pid, nullptr, 0);
  return start;
}

namespace {

constexpr int kKillPeriodMs = 20;  // for processes forked meanwhile

/// adit-watch must outlive its descendants, so it ignores the signals of the terminal and the
/// group.
void ignore_signals() {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGTTIN, SIGTTOU, SIGTSTP}) {
    std::signal(signal, SIG_IGN);
  }
}

int open_child_signalfd() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGCHLD);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

/// Must be called before this process opens descriptors. −1 without a socket.
int take_listening_socket() {
  const bool passed = fcntl(kWatchListenDescriptor, F_SETFD, FD_CLOEXEC) == 0;
  return passed ? kWatchListenDescriptor : -1;
}

void set_close_on_exec() {
  fcntl(kWatchReportsDescriptor, F_SETFD, FD_CLOEXEC);
  fcntl(kWatchSignalsDescriptor, F_SETFD, FD_CLOEXEC);
  fcntl(kWatchSignalsDescriptor, F_SETFL, O_NONBLOCK);
}

}  // namespace

Watch::Watch(const WatchOptions& options) : options_(options) {
  const int listening_socket = take_listening_socket();
  ignore_signals();
  set_close_on_exec();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  child_signals_ = open_child_signalfd();
  if (child_signals_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  program_ = start_program(options_.argv, listening_socket);
  const bool runs = program_.error == 0;
  report(runs ? WatchReport::Kind::kStarted : WatchReport::Kind::kStartFailed,
         runs ? program_.pid : program_.error);
}

void Watch::run() {
  for (reap(); any_child_left_; reap()) {
    if (kill_at_us_ && steady_us() >= *kill_at_us_) killing_ = true;
    if (killing_) send_to_all(SIGKILL);
    // The closed connection of an ended supervisor would wake poll() continuously.
    const int signals = killing_ ? -1 : kWatchSignalsDescriptor;
    std::array<pollfd, 2> descriptors{{{signals, POLLIN, 0}, {child_signals_, POLLIN, 0}}};
    poll(descriptors.data(), descriptors.size(), timeout_ms());
    if (descriptors[0].revents != 0) forward_signals();
  }
}

int Watch::timeout_ms() const {
  if (killing_) return kKillPeriodMs;
  if (!kill_at_us_) return -1;
  return static_cast<int>(std::max<std::int64_t>(*kill_at_us_ - steady_us(), 0) / 1000) + 1;
}

void Watch::forward_signals() {
  std::uint8_t signal = 0;
  const ssize_t n = read(kWatchSignalsDescriptor, &signal, 1);
  if (n < 0 && errno == EAGAIN) return;
  if (n <= 0 || signal == SIGKILL) {
    killing_ = true;
    return;
  }
  send_to_all(signal);
  send_to_all(SIGCONT);  // a stopped process does not handle other signals
}

void Watch::send_to_all(int signal) const {
  for (const pid_t pid : ProcessTable::read().descendants_of(getpid())) kill(pid, signal);
}

void Watch::reap() {
  signalfd_siginfo info{};
  while (read(child_signals_, &info, sizeof(info)) > 0) {
  }
  int status = 0;
  pid_t pid = 0;
  while ((pid = waitpid(-1, &status, WNOHANG)) > 0) {
    if (pid != program_.pid) continue;
    report(WatchReport::Kind::kEnded, status);
    send_to_all(options_.stop_signal);
    kill_at_us_ = steady_us() + std::llround(options_.stop_time_s * 1e6);
  }
  any_child_left_ = pid == 0;
}

void Watch::report(WatchReport::Kind kind, int number) const {
  const WatchReport report{kind, number};
  [[maybe_unused]] const ssize_t written = write(kWatchReportsDescriptor, &report, sizeof(report));
}

}  // namespace adit
