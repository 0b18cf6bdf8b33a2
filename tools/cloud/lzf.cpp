// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/lzf.hpp"

namespace adit {
namespace {

constexpr std::size_t kLongestPerByte = 264 / 3 + 1;  // three bytes repeat 264 at most
constexpr unsigned kLiteral = 32;                     // below it, a count of bytes as they are

}  // namespace

std::optional<std::vector<std::uint8_t>> unpack_lzf(std::span<const std::uint8_t> packed,
                                                    std::size_t size) {
  if (size / kLongestPerByte > packed.size()) return std::nullopt;
  std::vector<std::uint8_t> out;
  out.reserve(size);
  for (std::size_t in = 0; in < packed.size();) {
    const unsigned control = packed[in++];
    if (control < kLiteral) {
      const std::size_t length = control + 1;
      if (length > packed.size() - in || length > size - out.size()) return std::nullopt;
      const auto from = packed.subspan(in, length);
      out.insert(out.end(), from.begin(), from.end());
      in += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7 && in < packed.size()) length += packed[in++];
    if (in == packed.size()) return std::nullopt;
    const std::size_t back = ((control & 0x1fU) << 8U) + packed[in++] + 1;
    length += 2;
    if (back > out.size() || length > size - out.size()) return std::nullopt;
    for (; length > 0; --length) out.push_back(out[out.size() - back]);  // may overlap itself
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace adit
