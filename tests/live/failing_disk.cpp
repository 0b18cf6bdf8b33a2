// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A shared library for LD_PRELOAD: the disk below a folder fails. Environment:
//   FAIL_BELOW  files whose absolute path begins so
//   FAIL_AFTER  bytes that they take together before they fail (default: none fails)
//   FAIL_WITH   EIO (default) or ENOSPC
//   FAIL_CALL   write (default), fsync, close or rename: the call that fails
//   FAIL_SHORT  writes take at most so many bytes, a pseudo-random number that depends on the
//   amount
//               written, and every third one is interrupted (EINTR)
// Calls of the C++ library, i.e. of its streams, reach these functions, those of stdio do not.
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include <dlfcn.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

bool is_below(const std::string& path) {
  const std::string folder = variable("FAIL_BELOW");
  if (folder.empty()) return false;
  if (path.empty() || path[0] == '/') return path.compare(0, folder.size(), folder) == 0;
  char working[4096] = {};
  return getcwd(working, sizeof(working)) != nullptr && is_below(working + ("/" + path));
}

bool is_below(int file) {
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  char path[4096] = {};
  return readlink(link.c_str(), path, sizeof(path) - 1) > 0 && is_below(std::string(path));
}

bool fails_in(const char* call) {
  const std::string chosen = variable("FAIL_CALL");
  return !variable("FAIL_AFTER").empty() && (chosen.empty() ? "write" : chosen) == call;
}

int error() { return variable("FAIL_WITH") == "ENOSPC" ? ENOSPC : EIO; }

std::uint64_t taken = 0;  // bytes
std::uint64_t calls = 0;

/// How many of the bytes the disk takes; -1 with errno if none.
ssize_t admitted(std::size_t bytes) {
  ++calls;
  if (const std::string most = variable("FAIL_SHORT"); !most.empty()) {
    if (calls % 3 == 0) {
      errno = EINTR;
      return -1;
    }
    const std::uint64_t mixed = (taken + calls) * 6364136223846793005ULL;
    const std::uint64_t size = 1 + (mixed >> 33U) % std::strtoull(most.c_str(), nullptr, 10);
    if (size < bytes) bytes = size;
  }
  if (fails_in("write")) {
    const std::uint64_t limit = std::strtoull(variable("FAIL_AFTER").c_str(), nullptr, 10);
    if (taken >= limit && bytes > 0) {
      errno = error();
      return -1;
    }
    if (bytes > limit - taken) bytes = limit - taken;
  }
  taken += bytes;
  return static_cast<ssize_t>(bytes);
}

template <class Write>
ssize_t checked(int file, std::size_t bytes, const Write& write) {
  if (!is_below(file)) return write(bytes);
  const ssize_t size = admitted(bytes);
  return size < 0 ? size : write(static_cast<std::size_t>(size));
}

template <class Call>
int checked_call(const char* name, bool concerned, const Call& call) {
  if (!concerned || !fails_in(name)) return call();
  if (std::strcmp(name, "close") == 0) call();  // the descriptor is gone nevertheless
  errno = error();
  return -1;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t)>("write");
  return checked(file, size, [&](size_t n) { return call(file, bytes, n); });
}

ssize_t writev(int file, const iovec* parts, int count) {
  // A write of the first part is a valid short write.
  static const auto call = original<ssize_t (*)(int, const iovec*, int)>("writev");
  if (!is_below(file)) return call(file, parts, count);
  int first = 0;
  while (first < count && parts[first].iov_len == 0) ++first;
  return first == count ? 0 : write(file, parts[first].iov_base, parts[first].iov_len);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return checked(file, size, [&](size_t n) { return call(file, bytes, n, offset); });
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  return checked(file, size, [&](size_t n) { return call(file, bytes, n, offset); });
}

int fsync(int file) {
  static const auto call = original<int (*)(int)>("fsync");
  return checked_call("fsync", is_below(file), [&] { return call(file); });
}

int close(int file) {
  static const auto call = original<int (*)(int)>("close");
  return checked_call("close", is_below(file), [&] { return call(file); });
}

int rename(const char* from, const char* to) {
  static const auto call = original<int (*)(const char*, const char*)>("rename");
  return checked_call("rename", is_below(std::string(from)), [&] { return call(from, to); });
}
}
