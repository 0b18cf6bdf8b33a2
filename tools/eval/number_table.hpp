// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A text table of finite numbers, separated by blanks, with a fixed number of columns. `#` starts
/// a comment; empty lines are skipped. Errors throw std::runtime_error with `name:line: reason`.
class NumberTable {
 public:
  NumberTable(std::istream& in, std::string_view name, std::size_t columns);

  /// The next row; nothing at the end.
  std::optional<std::vector<double>> next();

  /// Converts a time of the current row, in seconds since the epoch, to µs.
  [[nodiscard]] std::int64_t microseconds(double seconds) const;
  /// Throws the error of the current row.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  std::istream& in_;
  std::string name_;
  std::size_t columns_;
  std::size_t line_ = 0;
};

/// The content of the file. Throws as read_text_file does.
std::istringstream open_table(const std::filesystem::path& path);

}  // namespace adit
