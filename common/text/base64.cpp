// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/text/base64.hpp"

#include <cstddef>
#include <string_view>

namespace adit {
namespace {

constexpr std::string_view kBase64Digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t remaining = bytes.size() - i;
    std::uint32_t three = static_cast<std::uint32_t>(bytes[i]) << 16U;
    if (remaining > 1) three |= static_cast<std::uint32_t>(bytes[i + 1]) << 8U;
    if (remaining > 2) three |= bytes[i + 2];
    text += kBase64Digits[three >> 18U & 63U];
    text += kBase64Digits[three >> 12U & 63U];
    text += remaining > 1 ? kBase64Digits[three >> 6U & 63U] : '=';
    text += remaining > 2 ? kBase64Digits[three & 63U] : '=';
  }
  return text;
}

std::optional<std::string> bytes_of_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::string_view digits = text.substr(i, 4);
    if (i + 4 == text.size()) {
      if (digits.ends_with("==")) {
        digits.remove_suffix(2);
      } else if (digits.ends_with('=')) {
        digits.remove_suffix(1);
      }
    }
    std::uint32_t three = 0;
    for (const char digit : digits) {
      const std::size_t value = kBase64Digits.find(digit);
      if (value == std::string_view::npos) return std::nullopt;
      three = three << 6U | static_cast<std::uint32_t>(value);
    }
    three <<= 6U * (4U - static_cast<unsigned>(digits.size()));
    for (std::size_t k = 0; k + 1 < digits.size(); ++k)
      bytes.push_back(static_cast<char>(three >> (16U - 8U * static_cast<unsigned>(k)) & 0xFFU));
  }
  return bytes;
}

}  // namespace adit
