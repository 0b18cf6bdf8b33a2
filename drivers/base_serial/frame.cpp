// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/frame.hpp"

#include <algorithm>
#include <array>

namespace adit {
namespace {

constexpr std::array<std::uint8_t, 2> kStart{0xA5, 0x5A};
constexpr std::size_t kHeaderBytes = 5;
constexpr std::size_t kCrcBytes = 2;

}  // namespace

std::uint16_t base_crc(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1 ^ 0x1021U) & 0xFFFFU : crc << 1;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

std::vector<std::uint8_t> encode_base_frame(std::uint8_t type, std::uint8_t sequence,
                                            std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> bytes(kStart.begin(), kStart.end());
  for (const std::uint8_t byte : {type, static_cast<std::uint8_t>(payload.size()), sequence}) {
    bytes.push_back(byte);
  }
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  const std::uint16_t crc = base_crc(std::span(bytes).subspan(kStart.size()));
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

std::optional<BaseFrame> BaseDecoder::next() {
  while (true) {
    const auto& received = buffer_.bytes();
    const auto start = std::search(received.begin(), received.end(), kStart.begin(), kStart.end());
    const bool is_first_half = start == received.end() && !received.empty() &&
                               received.back() == kStart[0];  // the second is still to come
    buffer_.drop(static_cast<std::size_t>(start - received.begin()) - (is_first_half ? 1 : 0));
    const std::span<const std::uint8_t> bytes(buffer_.bytes());
    if (bytes.size() < kHeaderBytes) return std::nullopt;
    const std::size_t length = bytes[3];
    const std::size_t end = kHeaderBytes + length + kCrcBytes;
    if (length <= kBasePayloadMax) {
      if (bytes.size() < end) return std::nullopt;
      const std::uint16_t crc =
          base_crc(bytes.subspan(kStart.size(), kHeaderBytes - kStart.size() + length));
      if (bytes[end - 2] == (crc & 0xFF) && bytes[end - 1] == crc >> 8) {
        const auto payload = bytes.subspan(kHeaderBytes, length);
        BaseFrame frame{
            bytes[2], bytes[4], {payload.begin(), payload.end()}, buffer_.end_us(end), end};
        buffer_.drop(end);
        ++counts_.frames;
        return frame;
      }
    }
    ++counts_.corrupt;
    buffer_.drop(1);
  }
}

}  // namespace adit
