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

/// The lines of a text file, plain or gzip, in constant memory. A file that cannot be opened
/// throws std::runtime_error; later faults come as lines that carry them.
class GzipLineReader {
 public:
  struct Line {
    std::string_view text;   ///< without the line's end; valid until the next call
    std::string_view fault;  ///< why there is no text, or empty
  };

  explicit GzipLineReader(const std::filesystem::path& path);
  ~GzipLineReader();
  GzipLineReader(GzipLineReader&&) noexcept;
  GzipLineReader& operator=(GzipLineReader&&) noexcept;

  /// The next line, or nothing at the end.
  std::optional<Line> next();
  /// How much of the file, as it lies on the disk, has been read, 0 to 1.
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
  std::size_t start_ = 0;  // of the line that comes next, in the buffer
  bool ended_ = false;
  bool damaged_ = false;
  bool too_long_ = false;  // inside a line that was too long from its start
};

}  // namespace adit
