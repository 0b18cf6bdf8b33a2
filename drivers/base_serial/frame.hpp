// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/timing/timed_buffer.hpp"

namespace adit {

/// A frame of the protocol of README.md, in either direction: A5h, 5Ah, type, length of the
/// payload, sequence, payload, CRC (low byte first).
struct BaseFrame {
  std::uint8_t type = 0;
  std::uint8_t sequence = 0;
  std::vector<std::uint8_t> payload;
  std::int64_t end_us = 0;  ///< arrival of the last byte, as passed to BaseDecoder::add
  std::size_t bytes = 0;    ///< from the first to the last
};

/// Longest payload. A damaged length costs the decoder no more than this.
inline constexpr std::size_t kBasePayloadMax = 32;

/// CRC-16/CCITT of the bytes from the type to the end of the payload: polynomial 1021h, initial
/// value FFFFh, not reflected. Of the text "123456789": 29B1h.
std::uint16_t base_crc(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> encode_base_frame(std::uint8_t type, std::uint8_t sequence,
                                            std::span<const std::uint8_t> payload);

/// Finds the frames in a stream of bytes that may begin anywhere and be damaged. A damaged one
/// costs the bytes up to the next.
class BaseDecoder {
 public:
  struct Counts {
    std::int64_t frames = 0;
    std::int64_t corrupt = 0;  ///< wrong CRC
  };

  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us) {
    buffer_.add(bytes, arrival_us, byte_us);
  }

  /// The next complete frame.
  std::optional<BaseFrame> next();

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Forgets what is not complete, after a change of the baud rate.
  void clear() { buffer_.clear(); }

 private:
  TimedBuffer buffer_;
  Counts counts_;
};

}  // namespace adit
