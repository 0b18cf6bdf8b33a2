// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tilt/packet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr std::array<std::uint8_t, 4> kHeader{0xFF, 0xFF, 0xFD, 0x00};
constexpr std::uint8_t kStuffing = 0xFD;
constexpr std::uint8_t kStatus = 0x55;
constexpr std::size_t kUpToLength = 7;  // header, id, length
constexpr std::size_t kLengthMin = 4;   // instruction, error, CRC
constexpr std::size_t kLengthMax = 64;  // of what this driver reads; bounds what damage costs

bool ends_with_pattern(std::span<const std::uint8_t> bytes) {
  const std::size_t size = bytes.size();
  return size >= 3 && bytes[size - 3] == 0xFF && bytes[size - 2] == 0xFF && bytes[size - 1] == 0xFD;
}

/// From the instruction to the last parameter, without the bytes that were inserted.
std::vector<std::uint8_t> unstuffed(std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes;
  bool is_inserted = false;
  for (const std::uint8_t byte : content) {
    if (is_inserted && byte == kStuffing) {
      is_inserted = false;
      continue;
    }
    bytes.push_back(byte);
    is_inserted = ends_with_pattern(bytes);
  }
  return bytes;
}

}  // namespace

std::uint16_t dynamixel_crc(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1 ^ 0x8005U) & 0xFFFFU : crc << 1;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

std::vector<std::uint8_t> encode_instruction(std::uint8_t id, DynamixelInstruction instruction,
                                             std::span<const std::uint8_t> parameters) {
  std::vector<std::uint8_t> content{static_cast<std::uint8_t>(instruction)};
  for (const std::uint8_t byte : parameters) {
    content.push_back(byte);
    if (ends_with_pattern(content)) content.push_back(kStuffing);
  }
  const std::size_t length = content.size() + 2;
  std::vector<std::uint8_t> bytes(kHeader.begin(), kHeader.end());
  bytes.push_back(id);
  bytes.push_back(static_cast<std::uint8_t>(length & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(length >> 8));
  bytes.insert(bytes.end(), content.begin(), content.end());
  const std::uint16_t crc = dynamixel_crc(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

void DynamixelDecoder::add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us,
                           double byte_us) {
  byte_us_ = byte_us;
  buffer_.add(bytes, arrival_us, byte_us);
}

std::optional<DynamixelStatus> DynamixelDecoder::next() {
  while (true) {
    const auto& received = buffer_.bytes();
    const auto start =
        std::search(received.begin(), received.end(), kHeader.begin(), kHeader.end());
    if (start == received.end()) {  // its last bytes may begin a header
      buffer_.drop(received.size() - std::min(received.size(), kHeader.size() - 1));
      return std::nullopt;
    }
    buffer_.drop(static_cast<std::size_t>(start - received.begin()));
    const std::span<const std::uint8_t> bytes(buffer_.bytes());
    if (bytes.size() < kUpToLength) return std::nullopt;
    const std::size_t length = bytes[5] + 256U * bytes[6];
    const std::size_t end = kUpToLength + length;
    const bool has_length = length + 1 >= kLengthMin && length <= kLengthMax;
    if (has_length && bytes.size() < end) return std::nullopt;
    if (!has_length ||
        dynamixel_crc(bytes.first(end - 2)) != bytes[end - 2] + 256U * bytes[end - 1]) {
      ++counts_.corrupt;
      buffer_.drop(1);
      continue;
    }
    const std::uint8_t id = bytes[4];
    const auto content = unstuffed(bytes.subspan(kUpToLength, length - 2));
    const std::int64_t end_us = buffer_.end_us(end);
    buffer_.drop(end);
    if (content.size() < 2 || content[0] != kStatus) continue;
    ++counts_.packets;
    return DynamixelStatus{id,
                           content[1],
                           {content.begin() + 2, content.end()},
                           end_us - std::llround(static_cast<double>(end) * byte_us_),
                           end_us};
  }
}

}  // namespace adit
