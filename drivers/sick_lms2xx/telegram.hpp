// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/timing/timed_buffer.hpp"

namespace adit {

/// Telegrams of the SICK LMS-200, 211, 221 and 291 ("Telegrams for configuring and operating the
/// LMS2xx", SICK 8007954): STX (02h), address, length (low byte first) of what follows up to the
/// checksum, command, data, checksum (low byte first). Responses have 80h added to the address and
/// end with a status byte, which is the last of the data here. Before a response the laser sends
/// ACK (06h) or NACK (15h) alone.
struct LmsTelegram {
  std::uint8_t command = 0;
  std::vector<std::uint8_t> data;
  std::int64_t end_us = 0;  ///< arrival of the last byte, as passed to LmsDecoder::add

  /// Status byte of a response.
  [[nodiscard]] std::uint8_t status() const { return data.empty() ? 0 : data.back(); }
};

/// Bytes of the longest telegram from STX to checksum.
inline constexpr std::size_t kLmsTelegramBytesMax = 818;

/// The 16-bit checksum of a telegram from STX to the end of the data: polynomial 8005h over the
/// bytes, each with the one before it as high byte.
std::uint16_t lms_checksum(std::span<const std::uint8_t> bytes);

/// The bytes of a telegram to the laser with address 0. `content`: command and data.
std::vector<std::uint8_t> encode_lms_telegram(std::span<const std::uint8_t> content);

/// Finds the telegrams of a laser in a stream of bytes that may begin anywhere and be damaged: one
/// that starts with STX and whose checksum is right. A damaged one costs the bytes up to the next.
class LmsDecoder {
 public:
  struct Counts {
    std::int64_t telegrams = 0;
    std::int64_t corrupt = 0;        ///< wrong checksum
    std::int64_t garbage_bytes = 0;  ///< in no telegram
  };

  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us);

  /// The next complete telegram.
  std::optional<LmsTelegram> next();

  /// Whether a NACK was received since the last call.
  bool take_nack();

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Forgets what is not complete, after a change of the baud rate.
  void clear();

 private:
  void skip_to_start();

  TimedBuffer buffer_;
  bool nack_ = false;
  Counts counts_;
};

}  // namespace adit
