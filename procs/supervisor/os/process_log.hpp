// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {

/// A file with size-based rotation: a full file is renamed to "name.1", that one to "name.2" and so
/// on, up to a number of files. Appends to an existing file.
class RotatedFile {
 public:
  struct Limits {
    std::int64_t bytes_max = 4'000'000;  ///< of one file; a write is never split
    int files = 5;                       ///< including the current one
  };

  RotatedFile(std::filesystem::path path, const Limits& limits)
      : path_(std::move(path)), limits_(limits) {}

  /// Never throws, since a full disk must not stop the supervisor; see error().
  void write(std::string_view text);

  /// Why the last write failed, with the path; empty if it did not.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  bool open();
  void rotate();
  bool fail();

  std::filesystem::path path_;
  Limits limits_;
  FileDescriptor file_;
  std::int64_t bytes_ = 0;
  std::string error_;
};

/// Formats a time [µs since the epoch] as "2003-05-30T10:20:30.123Z".
std::string utc_text(std::int64_t utime);

/// Log files of one process: its output and its starts and ends, each line with the UTC wall clock
/// time. Buffered until flush(), to write once per poll instead of once per line.
class ProcessLog {
 public:
  /// Writes to "FOLDER/ID.log", with bytes of the id other than ASCII letters, digits, _ and -
  /// encoded as %XX. Writes nothing if `folder` is empty.
  ProcessLog(const std::filesystem::path& folder, const std::string& id,
             const RotatedFile::Limits& limits);

  void add(std::string_view line, std::int64_t utime);
  void flush();

  [[nodiscard]] std::string error() const { return file_ ? file_->error() : ""; }

 private:
  std::optional<RotatedFile> file_;
  std::string waiting_;
};

}  // namespace adit
