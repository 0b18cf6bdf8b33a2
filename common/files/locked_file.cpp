// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/files/locked_file.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

template <class Call>
auto retry(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

}  // namespace

LockedFile::LockedFile(const std::filesystem::path& path) : path_(path) {
  // Non-blocking: opening a pipe or a device must not hang before it is rejected.
  file_ =
      retry([&] { return open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0644); });
  if (file_ < 0) fail("cannot open", errno);
  try {
    require_regular_file();
    lock();
  } catch (...) {
    close(file_);
    throw;
  }
}

LockedFile::~LockedFile() { close(file_); }

std::uint64_t LockedFile::size() const {
  struct stat status {};
  if (fstat(file_, &status) != 0) fail("cannot read", errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void LockedFile::write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const auto written = retry(
        [&] { return pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset)); });
    if (written <= 0) fail("cannot write", written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void LockedFile::truncate(std::uint64_t size) const {
  if (retry([&] { return ftruncate(file_, static_cast<off_t>(size)); }) != 0) {
    fail("cannot truncate", errno);
  }
}

LockedFile::Reservation LockedFile::reserve(std::uint64_t offset, std::uint64_t end) const {
  if (end <= offset) return Reservation::kDone;
  const int result = retry([&] {
    return fallocate(file_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset),
                     static_cast<off_t>(end - offset));
  });
  if (result == 0) return Reservation::kDone;
  const bool is_full = errno == ENOSPC || errno == EDQUOT;
  return is_full ? Reservation::kNoSpace : Reservation::kNotSupported;
}

void LockedFile::sync() const {
  if (retry([&] { return fsync(file_); }) != 0) fail("cannot sync", errno);
}

void LockedFile::sync_folder() const {
  const auto parent = std::filesystem::absolute(path_).parent_path();
  const int folder =
      retry([&] { return open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (folder < 0) fail("cannot open its folder", errno);
  const int result = retry([&] { return fsync(folder); });
  const int error = errno;
  close(folder);
  if (result != 0) fail("cannot sync its folder", error);
}

void LockedFile::rename(const std::filesystem::path& path) {
  if (::rename(path_.c_str(), path.c_str()) != 0) fail("cannot rename", errno);
  path_ = path;
  sync_folder();
}

void LockedFile::fail(const std::string& what, int error) const {
  throw FileError(path_.string() + ": " + what + ": " + std::generic_category().message(error));
}

void LockedFile::require_regular_file() const {
  struct stat status {};
  if (fstat(file_, &status) != 0) fail("cannot read", errno);
  if (!S_ISREG(status.st_mode)) {
    throw FileError(path_.string() + ": not a regular file");
  }
}

void LockedFile::lock() const {
  if (retry([&] { return flock(file_, LOCK_EX | LOCK_NB); }) == 0) return;
  if (errno != EWOULDBLOCK) fail("cannot lock", errno);
  throw FileError(path_.string() + ": in use by another process");
}

}  // namespace adit
