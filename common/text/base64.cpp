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

}  // namespace adit
