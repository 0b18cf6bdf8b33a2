// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace adit {

namespace detail {
struct Mapping;
}

/// A file mapped for reading. Throws FileError with path and reason.
///
/// A page that cannot be read later, because the disk has an error there or because the file was
/// truncated meanwhile, holds zeros and does not end the process: the signal of the kernel
/// (SIGBUS) is handled for mapped files. Who reads asks whether what was read is what was written.
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

  /// Whether these bytes of the file can be read; reads the pages that hold them.
  [[nodiscard]] bool is_readable(std::span<const std::uint8_t> part) const;

  /// Bytes in pages that could not be read when they were accessed.
  [[nodiscard]] std::size_t unreadable_bytes() const;

  /// Throws FileError if a page could not be read, for readers that cannot do without any.
  void require_readable() const;

 private:
  std::filesystem::path path_;
  std::span<const std::uint8_t> bytes_;
  detail::Mapping* mapping_ = nullptr;
};

}  // namespace adit
