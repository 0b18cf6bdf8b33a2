// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace adit {

/// A file with an exclusive writer: an advisory lock that holds against every other LockedFile, in
/// this process or another. Every failure throws FileError with one line: path and reason.
class LockedFile {
 public:
  /// Creates the file if it does not exist. Throws if the file is locked or is not a regular file.
  explicit LockedFile(const std::filesystem::path& path);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  /// Writes all bytes or throws; bytes written before the error remain.
  void write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes) const;
  /// Also gives back what is reserved beyond that size.
  void truncate(std::uint64_t size) const;

  enum class Reservation {
    kDone,
    kNoSpace,
    kNotSupported  ///< by the file system
  };
  /// Reserves the space of the bytes from `offset` to `end` on the disk, so that they can be
  /// written when it is full. The size and the content of the file do not change.
  [[nodiscard]] Reservation reserve(std::uint64_t offset, std::uint64_t end) const;

  /// Returns when the written data is on the disk.
  void sync() const;
  /// Returns when the directory entry of the file is on the disk.
  void sync_folder() const;
  /// Gives the file another path in the same folder, in place of the file that is there. Returns
  /// when that is on the disk.
  void rename(const std::filesystem::path& path);

 private:
  [[noreturn]] void fail(const std::string& what, int error) const;
  void require_regular_file() const;
  void lock() const;

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace adit
