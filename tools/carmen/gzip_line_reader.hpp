// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/files/gzip_file.hpp"

namespace adit {

/// Reads the lines of a text file, plain or gzip, in constant memory. Throws std::runtime_error if
/// the file cannot be opened; later errors are reported in `Line::error` and `damage`.
class GzipLineReader {
 public:
  struct Line {
    std::string_view text;   ///< without the line end; valid until the next call
    std::string_view error;  ///< reason why the text is missing, or empty
  };

  explicit GzipLineReader(const std::filesystem::path& path);

  /// Next line, or nothing at the end.
  std::optional<Line> next();
  /// Fraction of the (compressed) file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const { return file_.fraction_read(); }
  /// What is lost of a compressed file, after the end; empty if it is intact (GzipFile).
  [[nodiscard]] const std::string& damage() const { return file_.damage(); }

 private:
  bool fill();
  Line take(std::size_t length, std::size_t separator);

  GzipFile file_;
  std::string buffer_;
  std::size_t start_ = 0;  // of the next line in the buffer
  bool ended_ = false;
  bool too_long_ = false;  // the current line exceeds the maximum length
};

}  // namespace adit
