// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/config/text_check.hpp"

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

std::optional<std::size_t> find_non_text_byte(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    const auto following = continuation_byte_count(byte);
    if (is_control(byte) || !following) return i;
    const std::string_view rest = bytes.substr(i + 1, *following);
    if (rest.size() < *following || !std::all_of(rest.begin(), rest.end(), is_continuation_byte))
      return i;
    i += 1 + *following;
  }
  return std::nullopt;
}

}  // namespace adit
