// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace adit {

/// Reads text lines from bytes, also from a text header in front of binary data, which rest() then
/// returns.
class TextLines {
 public:
  explicit TextLines(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Next line without its end, "\n" or "\r\n"; nothing at the end of the file.
  std::optional<std::string_view> next();
  /// Next line that has a token.
  std::optional<std::string_view> next_nonblank();

  /// Bytes after the last line.
  [[nodiscard]] std::span<const std::uint8_t> rest() const { return bytes_.subspan(offset_); }
  [[nodiscard]] std::size_t offset() const { return offset_; }  ///< of rest() [bytes]

  /// Throws std::runtime_error "line N: reason" with the number of the last line.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t offset_ = 0;
  std::size_t line_ = 0;
};

/// Removes the next token from the front and returns it; empty at the end. Separators are blanks,
/// commas and semicolons.
std::string_view take_token(std::string_view& text);

}  // namespace adit
