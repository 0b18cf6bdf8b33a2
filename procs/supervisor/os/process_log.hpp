// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "procs/supervisor/os/rotated_file.hpp"

namespace adit {

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

  [[nodiscard]] std::string trouble() const { return file_ ? file_->trouble() : ""; }

 private:
  std::optional<RotatedFile> file_;
  std::string waiting_;
};

}  // namespace adit
