// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A shared library for LD_PRELOAD: the disk below a folder fails. Environment:
//   FAIL_BELOW  files whose absolute path begins so
//   FAIL_AFTER  bytes that they take together before they fail (default: none fails)
//   FAIL_WITH   EIO (default) or ENOSPC
//   FAIL_CALL   write (default), fsync, close, rename or read: the call that fails
//   FAIL_BYTES  with FAIL_CALL=read: so many bytes from FAIL_AFTER on cannot be read, in each file
//               (default: all). Also through a mapping (SIGBUS), in whole pages.
//   FAIL_SHORT  writes take at most so many bytes, a pseudo-random number that depends on the
//   amount
//               written, and every third one is interrupted (EINTR)
// Calls of the C++ library, i.e. of its streams, reach these functions, those of stdio do not.
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/stat.h>
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

struct Range {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// What cannot be read of a file, of its size at most.
Range unreadable() {
  const std::uint64_t begin = std::strtoull(variable("FAIL_AFTER").c_str(), nullptr, 10);
  const std::string bytes = variable("FAIL_BYTES");
  return {begin, bytes.empty() ? UINT64_MAX : begin + std::strtoull(bytes.c_str(), nullptr, 10)};
}

/// How many of the bytes at an offset can be read before the first that cannot.
std::uint64_t readable_at(std::uint64_t offset, std::uint64_t bytes) {
  const Range bad = unreadable();
  if (offset >= bad.end || offset + bytes <= bad.begin) return bytes;
  return offset < bad.begin ? bad.begin - offset : 0;
}

template <class Read>
ssize_t checked_read(int file, std::uint64_t offset, std::size_t bytes, const Read& read) {
  if (!fails_in("read") || !is_below(file)) return read(bytes);
  const std::uint64_t size = readable_at(offset, bytes);
  if (size > 0 || bytes == 0) return read(static_cast<std::size_t>(size));
  // A disk has no errors beyond the end of a file.
  struct stat status {};
  if (fstat(file, &status) != 0 || offset >= static_cast<std::uint64_t>(status.st_size)) return 0;
  errno = EIO;
  return -1;
}

std::uint64_t position_in(int file) {
  const off_t position = lseek(file, 0, SEEK_CUR);
  return position < 0 ? 0 : static_cast<std::uint64_t>(position);
}

/// Lays pages of an empty file over those that cannot be read: an access raises SIGBUS.
void spoil(void* start, std::size_t bytes, std::uint64_t offset) {
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  const Range bad = unreadable();
  const std::uint64_t from = std::max(bad.begin, offset) / page * page;
  const std::uint64_t to = std::min<std::uint64_t>(bad.end, offset + bytes);
  if (from >= to) return;
  static const auto call = original<void* (*)(void*, size_t, int, int, int, off_t)>("mmap");
  const int empty = memfd_create("empty", 0);
  call(static_cast<char*>(start) + (from - offset), to - from, PROT_READ, MAP_PRIVATE | MAP_FIXED,
       empty, 0);
  close(empty);
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

ssize_t read(int file, void* bytes, size_t size) {
  static const auto call = original<ssize_t (*)(int, void*, size_t)>("read");
  return checked_read(file, position_in(file), size,
                      [&](size_t n) { return call(file, bytes, n); });
}

ssize_t pread(int file, void* bytes, size_t size, off_t offset) {
  static const auto call = original<ssize_t (*)(int, void*, size_t, off_t)>("pread");
  return checked_read(file, static_cast<std::uint64_t>(offset), size,
                      [&](size_t n) { return call(file, bytes, n, offset); });
}

ssize_t pread64(int file, void* bytes, size_t size, off64_t offset) {
  static const auto call = original<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
  return checked_read(file, static_cast<std::uint64_t>(offset), size,
                      [&](size_t n) { return call(file, bytes, n, offset); });
}

void* mmap(void* start, size_t bytes, int protection, int flags, int file, off_t offset) {
  static const auto call = original<void* (*)(void*, size_t, int, int, int, off_t)>("mmap");
  void* const mapped = call(start, bytes, protection, flags, file, offset);
  if (mapped != MAP_FAILED && file >= 0 && fails_in("read") && is_below(file))
    spoil(mapped, bytes, static_cast<std::uint64_t>(offset));
  return mapped;
}

void* mmap64(void* start, size_t bytes, int protection, int flags, int file, off64_t offset) {
  return mmap(start, bytes, protection, flags, file, offset);
}
}
