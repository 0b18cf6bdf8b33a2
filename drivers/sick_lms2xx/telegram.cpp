// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/telegram.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

constexpr std::uint8_t kStx = 0x02;
constexpr std::uint8_t kAck = 0x06;
constexpr std::uint8_t kNack = 0x15;
constexpr std::uint8_t kResponse = 0x80;  // in the address
constexpr std::size_t kHeaderBytes = 4;
constexpr std::size_t kChecksumBytes = 2;
constexpr std::size_t kContentMax = kLmsTelegramBytesMax - kHeaderBytes - kChecksumBytes;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value & 0xFF); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>(value >> 8 & 0xFF); }

}  // namespace

std::uint16_t lms_checksum(std::span<const std::uint8_t> bytes) {
  constexpr unsigned kPolynomial = 0x8005;
  unsigned sum = 0;
  unsigned previous = 0;
  for (const std::uint8_t byte : bytes) {
    sum = (sum & 0x8000U) != 0 ? (sum << 1 & 0xFFFFU) ^ kPolynomial : sum << 1;
    sum ^= previous << 8 | byte;
    previous = byte;
  }
  return static_cast<std::uint16_t>(sum);
}

std::vector<std::uint8_t> encode_lms_telegram(std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kHeaderBytes + content.size() + kChecksumBytes);
  for (const std::uint8_t byte :
       {kStx, std::uint8_t{0}, low(content.size()), high(content.size())}) {
    bytes.push_back(byte);
  }
  for (const std::uint8_t byte : content) bytes.push_back(byte);
  const std::uint16_t sum = lms_checksum(bytes);
  bytes.push_back(low(sum));
  bytes.push_back(high(sum));
  return bytes;
}

void LmsDecoder::add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us) {
  buffer_.add(bytes, arrival_us, byte_us);
}

void LmsDecoder::clear() {
  counts_.garbage_bytes += static_cast<std::int64_t>(buffer_.bytes().size());
  buffer_.clear();
}

bool LmsDecoder::take_nack() { return std::exchange(nack_, false); }

/// Drops what is before the next STX.
void LmsDecoder::skip_to_start() {
  const auto& bytes = buffer_.bytes();
  const auto start = std::find(bytes.begin(), bytes.end(), kStx);
  for (auto byte = bytes.begin(); byte != start; ++byte) {
    nack_ = nack_ || *byte == kNack;
    if (*byte != kAck && *byte != kNack) ++counts_.garbage_bytes;
  }
  buffer_.drop(static_cast<std::size_t>(start - bytes.begin()));
}

std::optional<LmsTelegram> LmsDecoder::next() {
  while (true) {
    skip_to_start();
    const std::span<const std::uint8_t> bytes(buffer_.bytes());
    if (bytes.size() < kHeaderBytes) return std::nullopt;
    const std::size_t content = bytes[2] + 256U * bytes[3];
    const bool is_header = (bytes[1] & kResponse) != 0 && content > 0 && content <= kContentMax;
    const std::size_t end = kHeaderBytes + content + kChecksumBytes;
    if (is_header && bytes.size() < end) return std::nullopt;
    if (is_header && lms_checksum(bytes.first(kHeaderBytes + content)) ==
                         bytes[end - 2] + 256U * bytes[end - 1]) {
      const auto data = bytes.begin() + kHeaderBytes + 1;
      LmsTelegram telegram{bytes[kHeaderBytes],
                           {data, data + static_cast<std::ptrdiff_t>(content) - 1},
                           buffer_.end_us(end)};
      buffer_.drop(end);
      ++counts_.telegrams;
      return telegram;
    }
    if (is_header) ++counts_.corrupt;
    ++counts_.garbage_bytes;
    buffer_.drop(1);
  }
}

}  // namespace adit
