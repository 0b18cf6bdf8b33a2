// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/telegram.hpp"

#include <algorithm>
#include <cmath>
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
  if (bytes.empty()) return;
  byte_us_ = byte_us;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  arrivals_.push_back({buffer_.size(), arrival_us});
}

void LmsDecoder::clear() {
  counts_.garbage_bytes += static_cast<std::int64_t>(buffer_.size());
  buffer_.clear();
  arrivals_.clear();
}

bool LmsDecoder::take_nack() { return std::exchange(nack_, false); }

void LmsDecoder::drop(std::size_t bytes) {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(bytes));
  for (Arrival& arrival : arrivals_) arrival.end -= std::min(arrival.end, bytes);
  while (!arrivals_.empty() && arrivals_.front().end == 0) arrivals_.pop_front();
}

/// Drops what is before the next STX.
void LmsDecoder::skip_to_start() {
  const auto start = std::find(buffer_.begin(), buffer_.end(), kStx);
  for (auto byte = buffer_.begin(); byte != start; ++byte) {
    nack_ = nack_ || *byte == kNack;
    if (*byte != kAck && *byte != kNack) ++counts_.garbage_bytes;
  }
  drop(static_cast<std::size_t>(start - buffer_.begin()));
}

/// Arrival of the byte before `end`: of its read, minus the bytes behind it on the line.
std::int64_t LmsDecoder::end_us(std::size_t end) const {
  for (const Arrival& arrival : arrivals_) {
    if (arrival.end < end) continue;
    return arrival.utime - std::llround(static_cast<double>(arrival.end - end) * byte_us_);
  }
  return 0;
}

std::optional<LmsTelegram> LmsDecoder::next() {
  while (true) {
    skip_to_start();
    if (buffer_.size() < kHeaderBytes) return std::nullopt;
    const std::size_t content = buffer_[2] + 256U * buffer_[3];
    const bool is_header = (buffer_[1] & kResponse) != 0 && content > 0 && content <= kContentMax;
    const std::size_t end = kHeaderBytes + content + kChecksumBytes;
    if (is_header && buffer_.size() < end) return std::nullopt;
    const std::span<const std::uint8_t> bytes(buffer_);
    if (is_header && lms_checksum(bytes.first(kHeaderBytes + content)) ==
                         buffer_[end - 2] + 256U * buffer_[end - 1]) {
      const auto data = buffer_.begin() + kHeaderBytes + 1;
      LmsTelegram telegram{buffer_[kHeaderBytes],
                           {data, data + static_cast<std::ptrdiff_t>(content) - 1},
                           end_us(end)};
      drop(end);
      ++counts_.telegrams;
      return telegram;
    }
    if (is_header) ++counts_.corrupt;
    ++counts_.garbage_bytes;
    drop(1);
  }
}

}  // namespace adit
