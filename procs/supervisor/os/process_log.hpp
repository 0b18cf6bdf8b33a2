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

/// A file that grows up to a bound and is then put aside as "name.1", what was there as "name.2"
/// and so on, up to a number of files. Goes on with a file that is there.
class RotatedFile {
 public:
  struct Limits {
    std::int64_t bytes_max = 4'000'000;  ///< of one file; what is written at once stays together
    int files = 5;                       ///< in all
  };

  RotatedFile(std::filesystem::path path, const Limits& limits)
      : path_(std::move(path)), limits_(limits) {}

  /// Never throws, since a full disk is to stop nobody; see trouble().
  void write(std::string_view text);

  /// Why the last writing failed, with the path; empty where it did not.
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

/// "2003-05-30T10:20:30.123Z" of a time [µs since the epoch].
std::string utc_text(std::int64_t utime);

/// What a process prints and how it fares, in files that outlast the supervisor; each line begins
/// with the wall clock's time. Written once per look, not by the line.
class ProcessLog {
 public:
  /// "FOLDER/ID.log", with bytes of the name that a file had better not have as %XX. An empty
  /// folder: nothing is kept.
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
