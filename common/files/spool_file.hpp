// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/files/temporary_file.hpp"

namespace adit {

/// Bytes that are rarely read again, outside memory: what is appended goes to a temporary file, so
/// that memory does not grow with it. What fits a block never reaches the disk.
class SpoolFile {
 public:
  /// In `folder`, see TemporaryFile.
  explicit SpoolFile(std::filesystem::path folder) : folder_(std::move(folder)) {}
  SpoolFile(SpoolFile&&) = default;
  SpoolFile& operator=(SpoolFile&&) = default;

  /// Returns the offset of the bytes. Throws FileError if the disk is full or fails.
  std::uint64_t append(std::span<const std::uint8_t> bytes);
  /// Reads bytes that were appended. Throws FileError.
  void read(std::uint64_t offset, std::span<std::uint8_t> bytes) const;
  /// Removes the bytes from an offset on.
  void truncate(std::uint64_t offset);
  [[nodiscard]] std::uint64_t size() const { return stored_ + block_.size(); }

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 18U;

  void store_block();

  std::filesystem::path folder_;
  std::unique_ptr<TemporaryFile> file_;  ///< empty: not yet needed
  std::uint64_t stored_ = 0;             ///< bytes in the file
  std::vector<std::uint8_t> block_;      ///< those behind it
};

}  // namespace adit
