// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace adit {

/// A file that has its name only when it is complete. It is written as `part()`, in the same
/// folder; `publish` gives it its name and replaces what had it. A device or a pipe, such as
/// /dev/stdout, is written directly.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path);
  /// Removes the part unless it was published.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  [[nodiscard]] const std::filesystem::path& part() const { return part_; }

  /// Returns when the closed part is on the disk under the name of the file. Throws
  /// FileError with path and reason.
  void publish();

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  bool published_ = false;
};

}  // namespace adit
