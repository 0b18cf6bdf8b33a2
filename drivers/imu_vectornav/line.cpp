// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/imu_vectornav/line.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::size_t kLineMax = 300;

/// Of a text between $ and CR. Nothing if the checksum is wrong.
std::optional<VnLine> line_of(std::string_view text) {
  const std::size_t star = text.rfind('*');
  if (star == std::string_view::npos) return std::nullopt;
  const std::string_view digits = text.substr(star + 1);
  const std::string_view content = text.substr(0, star);
  unsigned sum = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), sum, 16);
  const bool has_crc = digits.size() == 4;
  if ((digits.size() != 2 && !has_crc) || parsed.ptr != digits.data() + digits.size() ||
      sum != (has_crc ? vn_crc(content) : vn_checksum(content))) {
    return std::nullopt;
  }
  VnLine line{{}, {}, has_crc, 0, 0};
  std::size_t begin = 0;
  while (begin <= content.size()) {
    const std::size_t comma = std::min(content.find(',', begin), content.size());
    const std::string field(content.substr(begin, comma - begin));
    if (begin == 0) {
      line.header = field;
    } else {
      line.fields.push_back(field);
    }
    begin = comma + 1;
  }
  return line;
}

}  // namespace

std::uint8_t vn_checksum(std::string_view text) {
  std::uint8_t sum = 0;
  for (const char c : text) sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(c));
  return sum;
}

std::uint16_t vn_crc(std::string_view text) {
  unsigned crc = 0;
  for (const char c : text) {
    crc ^= static_cast<unsigned>(static_cast<std::uint8_t>(c)) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1 ^ 0x1021U) & 0xFFFFU : crc << 1;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

std::vector<std::uint8_t> encode_vn_line(std::string_view text) {
  const std::string line = fmt::format("${}*{:02X}\r\n", text, vn_checksum(text));
  return {line.begin(), line.end()};
}

std::optional<VnLine> VnDecoder::next() {
  while (true) {
    const auto& received = buffer_.bytes();
    const auto start = std::ranges::find(received, '$');
    buffer_.drop(static_cast<std::size_t>(start - received.begin()));
    const auto& bytes = buffer_.bytes();
    const auto end = std::ranges::find(bytes, '\n');
    if (end == bytes.end()) {
      if (bytes.size() <= kLineMax) return std::nullopt;
      buffer_.drop(1);
      continue;
    }
    // A $ within is the start of a line whose end was damaged.
    const auto last_start = std::find(std::make_reverse_iterator(end), bytes.rend(), '$');
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                static_cast<std::size_t>(end - bytes.begin()));
    const auto begin = static_cast<std::size_t>(bytes.rend() - last_start);  // behind the $
    const bool has_return = text.size() > begin && text.back() == '\r';
    auto line = has_return ? line_of(text.substr(begin, text.size() - begin - 1)) : std::nullopt;
    const std::size_t size = text.size() + 1;
    if (line) {
      line->end_us = buffer_.end_us(size);
      line->bytes = size - begin + 1;
      ++counts_.lines;
    } else {
      ++counts_.corrupt;
    }
    buffer_.drop(size);
    if (line) return line;
  }
}

}  // namespace adit
