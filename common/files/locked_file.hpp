// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace adit {

/// A file that this object alone writes: the lock is advisory and holds for all who open it as a
/// LockedFile, in this process or another. Every failure is a std::runtime_error of one line with
/// the path and the reason.
class LockedFile {
 public:
  /// Creates the file where it is not there. Fails too where another has it open, or where it is no
  /// ordinary file.
  explicit LockedFile(const std::filesystem::path& path);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const;

  /// All of the bytes, or an error; what was written before it stays written.
  void write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes) const;
  void truncate(std::uint64_t size) const;

  /// Returns once what was written is on the disk.
  void sync() const;
  /// Returns once the folder knows the file by its name.
  void sync_folder() const;

 private:
  [[noreturn]] void fail(const std::string& what, int error) const;
  void require_regular_file() const;
  void lock() const;

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace adit
