// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A text of rows with the same count of finite numbers, between blanks; `#` starts a comment and
/// empty lines do not count. What is wrong throws std::runtime_error with `name:line: reason`.
class NumberTable {
 public:
  NumberTable(std::istream& in, std::string_view name, std::size_t columns);

  /// The next row, or nothing at the end.
  std::optional<std::vector<double>> next();

  /// A time of the current row, in seconds since the epoch, as µs.
  [[nodiscard]] std::int64_t microseconds(double seconds) const;
  /// Refuses the current row.
  [[noreturn]] void fail(std::string_view reason) const;

 private:
  std::istream& in_;
  std::string name_;
  std::size_t columns_;
  std::size_t line_ = 0;
};

/// Throws std::runtime_error where the file cannot be read.
std::ifstream open_table(const std::filesystem::path& path);

}  // namespace adit
