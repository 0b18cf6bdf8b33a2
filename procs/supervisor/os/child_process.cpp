// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "common/service/wait_status.hpp"
#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {
namespace {

struct SpawnOptions {
  std::vector<std::string> arguments;  ///< path of the program first
  std::vector<std::string> environment;
  std::vector<int> descriptors;  ///< become 0, 1, 2, ...; must be higher; no others are inherited
  std::filesystem::path folder;  ///< empty: that of this process
};

/// Starts a program with no signals blocked or ignored and returns its process id. Uses
/// posix_spawn: no code of this process runs in the child, which is required with threads. Throws
/// std::system_error.
pid_t spawn(const SpawnOptions& options);

/// The environment of this process with the additions, and with `folder` appended to PATH.
std::vector<std::string> environment_with(
    const std::vector<std::pair<std::string, std::string>>& additions, const std::string& folder);

/// Owns the attributes and file actions of posix_spawn.
class SpawnAttributes {
 public:
  SpawnAttributes(const std::vector<int>& descriptors, const std::filesystem::path& folder) {
    posix_spawn_file_actions_init(&actions);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      posix_spawn_file_actions_adddup2(&actions, descriptors[i], static_cast<int>(i));
    }
    posix_spawn_file_actions_addclosefrom_np(&actions, static_cast<int>(descriptors.size()));
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID);
  }
  ~SpawnAttributes() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

pid_t spawn(const SpawnOptions& options) {
  const SpawnAttributes spawn_attributes(options.descriptors, options.folder);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, options.arguments.front().c_str(), &spawn_attributes.actions,
                                &spawn_attributes.attributes, pointers_to(options.arguments).data(),
                                pointers_to(options.environment).data());
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), options.arguments.front());
  }
  return pid;
}

std::vector<std::string> environment_with(
    const std::vector<std::pair<std::string, std::string>>& additions, const std::string& folder) {
  std::map<std::string, std::string> values;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const std::size_t sign = text.find('=');
    if (sign != std::string::npos) values[text.substr(0, sign)] = text.substr(sign + 1);
  }
  std::string& path = values["PATH"];
  path += (path.empty() ? "/usr/local/bin:/usr/bin:/bin:" : ":") + folder;
  for (const auto& [name, value] : additions) values[name] = value;
  std::vector<std::string> environment;
  for (auto& [name, value] : values) environment.push_back(value.insert(0, name + "="));
  return environment;
}

/// A pseudo terminal, on which programs use line-buffered output. Without output processing and
/// without echo.
struct PseudoTerminal {
  FileDescriptor parent_end;  ///< non-blocking
  FileDescriptor child_end;

  /// Throws std::system_error.
  static PseudoTerminal open();
};

void require(bool succeeded, const char* what) {
  if (!succeeded) throw std::system_error(errno, std::generic_category(), what);
}

void set_raw_mode(int terminal) {
  termios settings{};
  require(tcgetattr(terminal, &settings) == 0, "tcgetattr");
  settings.c_oflag &= ~static_cast<tcflag_t>(OPOST);
  settings.c_lflag &= ~static_cast<tcflag_t>(ECHO | ECHONL);
  require(tcsetattr(terminal, TCSANOW, &settings) == 0, "tcsetattr");
}

PseudoTerminal PseudoTerminal::open() {
  PseudoTerminal terminal;
  terminal.parent_end = FileDescriptor(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  require(static_cast<bool>(terminal.parent_end), "posix_openpt");
  require(grantpt(terminal.parent_end.get()) == 0 && unlockpt(terminal.parent_end.get()) == 0,
          "unlockpt");
  std::array<char, 64> name{};
  require(ptsname_r(terminal.parent_end.get(), name.data(), name.size()) == 0, "ptsname");
  terminal.child_end = FileDescriptor(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  require(static_cast<bool>(terminal.child_end), "a pseudo terminal");
  set_raw_mode(terminal.child_end.get());
  return terminal;
}

constexpr int kAboveStandard = 10;  // source descriptors must not collide with the targets of dup2

FileDescriptor copy_above_standard(int descriptor) {
  FileDescriptor high(fcntl(descriptor, F_DUPFD_CLOEXEC, kAboveStandard));
  if (!high) throw std::system_error(errno, std::generic_category(), "fcntl");
  return high;
}

FileDescriptor moved_above_standard(FileDescriptor descriptor) {
  return copy_above_standard(descriptor.get());
}

/// What a program reads from and writes to.
struct StandardStreams {
  FileDescriptor terminal;  ///< our end of the terminal; none if the output goes elsewhere
  FileDescriptor input;
  FileDescriptor output;
};

StandardStreams open_streams(const std::optional<int>& output) {
  StandardStreams streams;
  if (output) {
    FileDescriptor empty(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    require(static_cast<bool>(empty), "/dev/null");
    streams.input = moved_above_standard(std::move(empty));
    streams.output = copy_above_standard(*output);
    return streams;
  }
  PseudoTerminal terminal = PseudoTerminal::open();
  streams.terminal = std::move(terminal.parent_end);
  streams.input = moved_above_standard(std::move(terminal.child_end));
  streams.output = copy_above_standard(streams.input.get());
  return streams;
}

/// Connection to adit-watch. Sockets instead of pipes: a write after the peer has closed returns an
/// error (MSG_NOSIGNAL) instead of raising SIGPIPE.
struct SocketPair {
  FileDescriptor parent_end;
  FileDescriptor child_end;
};

SocketPair make_socket_pair() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  FileDescriptor parent_end(ends[0]);
  FileDescriptor child_end(ends[1]);
  return {moved_above_standard(std::move(parent_end)), moved_above_standard(std::move(child_end))};
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::vector<std::string> arguments_of(const ChildStart& start) {
  std::vector<std::string> arguments{start.watcher.string(), std::to_string(start.stop_signal),
                                     std::to_string(start.stop_time_s)};
  arguments.insert(arguments.end(), start.line.arguments.begin(), start.line.arguments.end());
  return arguments;
}

}  // namespace

std::string ChildProcess::End::text() const { return wait_status_text(wait_status); }

ChildProcess::ChildProcess(const ChildStart& start) {
  StandardStreams streams = open_streams(start.output);
  SocketPair reports = make_socket_pair();
  SocketPair signals = make_socket_pair();
  std::vector<int> descriptors{streams.input.get(), streams.output.get(), streams.output.get(),
                               reports.child_end.get(), signals.child_end.get()};
  FileDescriptor listening_socket;
  if (start.listening_socket) {
    listening_socket = copy_above_standard(*start.listening_socket);
    descriptors.push_back(listening_socket.get());  // kWatchListenDescriptor
  }
  watcher_ = spawn({arguments_of(start),
                    environment_with(start.line.environment, start.watcher.parent_path().string()),
                    descriptors, start.folder});
  fcntl(signals.parent_end.get(), F_SETFL, O_NONBLOCK);
  terminal_ = std::move(streams.terminal);
  reports_ = std::move(reports.parent_end);
  signals_ = std::move(signals.parent_end);
  reports.child_end.reset();  // otherwise the end of adit-watch would not be detected
  wait_for_start();
}

/// adit-watch kills all remaining processes when the connection closes; waiting for it takes
/// milliseconds.
ChildProcess::~ChildProcess() {
  if (watcher_ <= 0) return;
  signals_.reset();
  terminal_.reset();
  waitpid(watcher_, nullptr, 0);
}

void ChildProcess::wait_for_start() {
  WatchReport report;
  const bool received = read(reports_.get(), &report, sizeof(report)) == sizeof(report);
  if (received && report.kind == WatchReport::Kind::kStarted) {
    pid_ = report.number;
    fcntl(reports_.get(), F_SETFL, O_NONBLOCK);
    return;
  }
  waitpid(watcher_, nullptr, 0);
  throw std::runtime_error("cannot be started: " +
                           (received ? std::generic_category().message(report.number)
                                     : std::string("adit-watch ended")));
}

std::optional<ChildProcess::End> ChildProcess::poll() {
  if (watcher_ <= 0) return std::nullopt;
  int status = 0;
  rusage usage{};
  const bool gone = wait4(watcher_, &status, WNOHANG, &usage) == watcher_;
  read_reports();
  if (!gone) return std::nullopt;
  watcher_ = -1;
  End end = end_.value_or(End{status});  // if adit-watch was killed, so was the program
  end.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  end.memory_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
  return end;
}

void ChildProcess::read_reports() {
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
    if (n <= 0) break;  // no data, or the other end is closed
    output.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return output;
}

void ChildProcess::send(int signal) const {
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = ::send(signals_.get(), &byte, 1, MSG_NOSIGNAL);
}

}  // namespace adit
