// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <string>
#include <system_error>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr std::uint8_t kDone = 0;
constexpr std::uint8_t kFailed = 1;

[[noreturn]] void fail(const char* call) {
  throw std::system_error(errno, std::generic_category(), call);
}

void write_all(int descriptor, const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0) fail("write");
    done += static_cast<std::size_t>(n);
  }
}

Bytes read_all(int descriptor) {
  Bytes bytes;
  std::array<std::uint8_t, 65536> buffer{};
  while (true) {
    const ssize_t n = read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read");
    if (n == 0) return bytes;
    bytes.insert(bytes.end(), buffer.data(), buffer.data() + n);
  }
}

/// Sends kDone and the result, or kFailed and the error text.
Bytes outcome(const std::function<Bytes()>& work) try {
  Bytes bytes = work();
  bytes.insert(bytes.begin(), kDone);
  return bytes;
} catch (const std::exception& error) {
  const std::string text = error.what();
  Bytes bytes(text.begin(), text.end());
  bytes.insert(bytes.begin(), kFailed);
  return bytes;
}

/// Exits without the exit handlers of the parent.
[[noreturn]] void run_child(const std::function<Bytes()>& work, int seconds, int descriptor) {
  const rlimit limit{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds)};
  setrlimit(RLIMIT_CPU, &limit);
  try {
    write_all(descriptor, outcome(work));
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail("waitpid");
  }
  return status;
}

}  // namespace

Bytes run_in_child_process(const std::function<Bytes()>& work, int seconds) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) fail("pipe");
  const pid_t child = fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    close(ends[0]);
    run_child(work, seconds, ends[1]);
  }
  close(ends[1]);
  Bytes bytes = read_all(ends[0]);
  close(ends[0]);
  const int status = wait_for(child);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    throw ChildProcessError("it takes too long to read");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) {
    throw ChildProcessError("its reader crashed");
  }
  const bool failed = bytes.front() == kFailed;
  bytes.erase(bytes.begin());
  if (failed) throw std::runtime_error(std::string(bytes.begin(), bytes.end()));
  return bytes;
}

}  // namespace adit
