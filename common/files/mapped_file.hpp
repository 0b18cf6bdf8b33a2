// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace adit {

/// A file mapped for reading. Throws FileError with path and reason.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

  /// Drops the resident pages between two offsets, for a reader that has passed them, so that a
  /// file of any length takes little memory. The bytes stay valid: a page is read again on access.
  void release(std::size_t from, std::size_t to) const;

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace adit
