// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace adit {

/// A file that is written from its beginning to its end. Every failure throws FileError with one
/// line: path and reason.
class OutputFile {
 public:
  /// Creates the file, or empties it. Errors name `name`, for a file that gets another name later.
  OutputFile(const std::filesystem::path& path, std::filesystem::path name);
  explicit OutputFile(const std::filesystem::path& path) : OutputFile(path, path) {}
  /// Closes the file without reporting an error; see `close`.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes all bytes, however many calls of the system that takes. After a failure the file ends
  /// where it ended before the call, if it can be shortened.
  void write(std::string_view bytes);

  /// Network file systems report errors of earlier writes here.
  void close();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path name_;
  int file_ = -1;
  std::uint64_t bytes_ = 0;
};

}  // namespace adit
