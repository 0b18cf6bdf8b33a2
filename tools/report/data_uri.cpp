// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/data_uri.hpp"

#include <cstddef>
#include <string_view>

namespace adit {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string data_uri(const std::string& media_type, std::span<const std::uint8_t> bytes) {
  std::string uri = "data:" + media_type + ";base64,";
  uri.reserve(uri.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    std::uint32_t three = static_cast<std::uint32_t>(bytes[i]) << 16U;
    if (left > 1) three |= static_cast<std::uint32_t>(bytes[i + 1]) << 8U;
    if (left > 2) three |= bytes[i + 2];
    uri += kDigits[three >> 18U & 63U];
    uri += kDigits[three >> 12U & 63U];
    uri += left > 1 ? kDigits[three >> 6U & 63U] : '=';
    uri += left > 2 ? kDigits[three & 63U] : '=';
  }
  return uri;
}

}  // namespace adit
