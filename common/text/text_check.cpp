// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/text/text_check.hpp"

#include <algorithm>

namespace adit {
namespace {

bool is_control(unsigned char byte) {
  const bool is_space = byte == '\t' || byte == '\n' || byte == '\r';
  return (byte < 0x20 && !is_space) || byte == 0x7F;
}

/// Number of continuation bytes after the first byte of a UTF-8 character; nothing if the byte
/// cannot begin one.
std::optional<std::size_t> continuation_byte_count(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first <= 0xDF) return 1;
  if (first >= 0xE0 && first <= 0xEF) return 2;
  if (first >= 0xF0 && first <= 0xF4) return 3;
  return std::nullopt;
}

bool is_continuation_byte(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

std::size_t text_character_bytes(std::string_view bytes) {
  if (bytes.empty()) return 0;
  const auto first = static_cast<unsigned char>(bytes.front());
  const auto following = continuation_byte_count(first);
  if (is_control(first) || !following) return 0;
  const std::string_view rest = bytes.substr(1, *following);
  if (rest.size() < *following || !std::all_of(rest.begin(), rest.end(), is_continuation_byte)) {
    return 0;
  }
  return 1 + *following;
}

std::optional<std::size_t> find_non_text_byte(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t length = text_character_bytes(bytes.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::nullopt;
}

}  // namespace adit
