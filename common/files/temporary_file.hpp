// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// A file without a name, which ends with this object or the process.
class TemporaryFile {
 public:
  /// In `folder`, or in the folder for temporary files if nothing can be created there. Throws
  /// FileError.
  explicit TemporaryFile(const std::filesystem::path& folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Opens it as long as this object exists.
  [[nodiscard]] std::filesystem::path path() const;
  /// Open for reading and writing.
  [[nodiscard]] int descriptor() const { return file_; }

 private:
  int file_ = -1;
};

}  // namespace adit
