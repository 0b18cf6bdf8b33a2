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

/// The lines of a file, and of one that is text only at its beginning: what is left goes on from
/// behind the last line.
class TextLines {
 public:
  explicit TextLines(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Without its end, "\n" or "\r\n"; nothing at the end of the file.
  std::optional<std::string_view> next();
  /// The next in which there is more than blanks.
  std::optional<std::string_view> next_nonblank();

  [[nodiscard]] std::span<const std::uint8_t> rest() const { return bytes_.subspan(done_); }
  [[nodiscard]] std::size_t offset() const { return done_; }  ///< of the rest [bytes]

  /// Throws std::runtime_error: "line 7: what", of the last line.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t done_ = 0;
  std::size_t line_ = 0;
};

/// Takes the next word off the front; empty at the end. Blanks, commas and semicolons are between
/// words.
std::string_view take_token(std::string_view& text);

}  // namespace adit
