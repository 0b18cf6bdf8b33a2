// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/text/message_text.hpp"

#include <algorithm>
#include <cstddef>
#include <iostream>

#include <fmt/format.h>

#include "common/text/text_check.hpp"

namespace adit {
namespace {

constexpr std::size_t kQuotedBytesMax = 80;
constexpr std::size_t kLineBytesMax = 2000;

/// Characters beyond ASCII that act instead of being shown: the control characters C1 (U+0080 to
/// U+009F), separators of lines (U+2028, U+2029), directional formatting (U+202A to U+202E, U+2066
/// to U+2069).
bool acts(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 2) return byte(0) == 0xC2 && byte(1) < 0xA0;
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  return (byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE) ||
         (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9);
}

/// Appends the first character of `rest` to `out`, escaped if necessary. Returns its bytes.
std::size_t append_character(std::string& out, std::string_view rest, bool keep_lines) {
  const std::size_t length = text_character_bytes(rest);
  const std::string_view character = rest.substr(0, std::max<std::size_t>(length, 1));
  if (character == "\n" || character == "\t") {
    out += keep_lines ? character : character == "\n" ? "\\n" : "\\t";
  } else if (length == 0 || character == "\r" || acts(character)) {
    for (const char c : character) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  } else {
    out += character;
  }
  return character.size();
}

/// The beginning of the text with at most `bytes_max` bytes after escapes; `text` becomes the rest.
std::string escaped(std::string_view& text, std::size_t bytes_max, bool keep_lines = false) {
  std::string out;
  while (!text.empty()) {
    const std::size_t before = out.size();
    const std::size_t taken = append_character(out, text, keep_lines);
    if (out.size() > bytes_max) {
      out.resize(before);
      break;
    }
    text.remove_prefix(taken);
  }
  return out;
}

}  // namespace

std::string quote(std::string_view text, char mark) {
  const std::size_t bytes = text.size();
  const std::string shown = escaped(text, kQuotedBytesMax);
  return text.empty() ? fmt::format("{0}{1}{0}", mark, shown)
                      : fmt::format("{0}{1}..{0} ({2} bytes)", mark, shown, bytes);
}

std::string message_line(std::string_view message) {
  std::string shown = escaped(message, kLineBytesMax);
  return message.empty() ? shown : shown + "..";
}

std::string printable_lines(std::string_view text) {
  return escaped(text, std::string::npos, true);
}

void print_error(std::string_view program, std::string_view message) {
  std::cerr << fmt::format("{}: {}\n", message_line(program), message_line(message));
}

}  // namespace adit
