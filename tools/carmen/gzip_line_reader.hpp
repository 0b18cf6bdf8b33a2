// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct gzFile_s;

namespace adit {

/// Reads the lines of a text file, plain or gzip, in constant memory. Throws std::runtime_error if
/// the file cannot be opened; later errors are reported in `Line::error`.
class GzipLineReader {
 public:
  struct Line {
    std::string_view text;   ///< without the line end; valid until the next call
    std::string_view error;  ///< reason why the text is missing, or empty
  };

  explicit GzipLineReader(const std::filesystem::path& path);
  ~GzipLineReader();
  GzipLineReader(GzipLineReader&&) noexcept;
  GzipLineReader& operator=(GzipLineReader&&) noexcept;

  /// Next line, or nothing at the end.
  std::optional<Line> next();
  /// Fraction of the (compressed) file that has been read, 0 to 1.
  [[nodiscard]] double fraction_read() const;

 private:
  struct Close {
    void operator()(gzFile_s* file) const;
  };

  bool fill();
  Line take(std::size_t length, std::size_t separator);

  std::unique_ptr<gzFile_s, Close> file_;
  double size_bytes_ = 0.0;
  std::string buffer_;
  std::size_t start_ = 0;  // of the next line in the buffer
  bool ended_ = false;
  bool damaged_ = false;
  bool too_long_ = false;  // the current line exceeds the maximum length
};

}  // namespace adit
