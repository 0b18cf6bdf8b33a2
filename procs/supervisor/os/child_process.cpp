// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "procs/supervisor/os/pseudo_terminal.hpp"
#include "procs/supervisor/os/spawn.hpp"

namespace adit {
namespace {

constexpr int kBeyondStandard = 10;  // so that none is in the way when they get their places

Descriptor moved_up(Descriptor descriptor) {
  Descriptor high(fcntl(descriptor.get(), F_DUPFD_CLOEXEC, kBeyondStandard));
  if (!high) throw std::system_error(errno, std::generic_category(), "fcntl");
  return high;
}

/// One end for us, one for adit-watch. Sockets, not pipes: who writes to one whose other end is
/// gone gets an error and no SIGPIPE.
struct Line {
  Descriptor ours;
  Descriptor theirs;
};

Line make_line() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  Descriptor ours(ends[0]);
  Descriptor theirs(ends[1]);
  return {moved_up(std::move(ours)), moved_up(std::move(theirs))};
}

std::vector<std::string> arguments_of(const ChildStart& start) {
  std::vector<std::string> arguments{start.watcher.string(), std::to_string(start.stop_signal),
                                     std::to_string(start.stop_time_s)};
  arguments.insert(arguments.end(), start.line.arguments.begin(), start.line.arguments.end());
  return arguments;
}

std::string signal_text(int signal) {
  const char* const name = sigabbrev_np(signal);
  return name ? "SIG" + std::string(name) : "signal " + std::to_string(signal);
}

}  // namespace

std::string ChildProcess::End::text() const {
  if (WIFSIGNALED(wait_status)) return "killed by " + signal_text(WTERMSIG(wait_status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(wait_status));
}

ChildProcess::ChildProcess(const ChildStart& start) {
  PseudoTerminal terminal = PseudoTerminal::open();
  Line reports = make_line();
  Line signals = make_line();
  const Descriptor theirs = moved_up(std::move(terminal.theirs));
  watcher_ = spawn(
      {arguments_of(start),
       environment_with(start.line.environment, start.watcher.parent_path().string()),
       {theirs.get(), theirs.get(), theirs.get(), reports.theirs.get(), signals.theirs.get()}});
  fcntl(signals.ours.get(), F_SETFL, O_NONBLOCK);
  terminal_ = std::move(terminal.ours);
  reports_ = std::move(reports.ours);
  signals_ = std::move(signals.ours);
  reports.theirs.reset();  // else its end would not be heard
  wait_until_it_runs();
}

/// Whoever is left is killed by adit-watch when the line closes. It is waited for: milliseconds.
ChildProcess::~ChildProcess() {
  if (watcher_ <= 0) return;
  signals_.reset();
  terminal_.reset();
  waitpid(watcher_, nullptr, 0);
}

void ChildProcess::wait_until_it_runs() {
  WatchReport report;
  const bool heard = read(reports_.get(), &report, sizeof(report)) == sizeof(report);
  if (heard && report.kind == WatchReport::Kind::kStarted) {
    pid_ = report.number;
    fcntl(reports_.get(), F_SETFL, O_NONBLOCK);
    return;
  }
  waitpid(watcher_, nullptr, 0);
  throw std::runtime_error("cannot be started: " +
                           (heard ? std::generic_category().message(report.number)
                                  : std::string("its adit-watch ended")));
}

std::optional<ChildProcess::End> ChildProcess::poll() {
  if (watcher_ <= 0) return std::nullopt;
  int status = 0;
  const bool gone = waitpid(watcher_, &status, WNOHANG) == watcher_;
  take_reports();
  if (!gone) return std::nullopt;
  watcher_ = -1;
  return end_.value_or(End{status});  // one whose adit-watch was killed went with it
}

void ChildProcess::take_reports() {
  WatchReport report;
  while (read(reports_.get(), &report, sizeof(report)) == sizeof(report)) {
    if (report.kind == WatchReport::Kind::kEnded) end_ = End{report.number};
  }
}

std::string ChildProcess::read_output(std::size_t bytes_max) const {
  std::string output;
  std::array<char, 4096> buffer;
  while (output.size() < bytes_max) {
    const ssize_t n = read(terminal_.get(), buffer.data(), buffer.size());
    if (n <= 0) break;  // nothing yet, or nobody has the other end any more
    output.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return output;
}

void ChildProcess::send(int signal) const {
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = ::send(signals_.get(), &byte, 1, MSG_NOSIGNAL);
}

}  // namespace adit
