// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/timing/timed_buffer.hpp"

namespace adit {

/// A line of the ASCII protocol of VectorNav (VN-100 user manual, "Serial communication"): $,
/// header and fields between commas, *, checksum of two or four hexadecimal digits, CR, LF.
struct VnLine {
  std::string header;               ///< "VNRRG", "VNIMU"
  std::vector<std::string> fields;  ///< behind it
  bool has_crc = false;             ///< the checksum has 16 bits
  std::int64_t end_us = 0;          ///< arrival of the line feed, as passed to VnDecoder::add
  std::size_t bytes = 0;            ///< from $ to the line feed
};

/// All characters between $ and * combined by exclusive or.
std::uint8_t vn_checksum(std::string_view text);

/// CRC-16 of the same: polynomial 1021h, initial value 0, not reflected.
std::uint16_t vn_crc(std::string_view text);

/// "$VNWRG,06,19*hh" with its end, checksum of eight bits, which every setting accepts.
std::vector<std::uint8_t> encode_vn_line(std::string_view text);

/// Finds the lines in a stream of bytes that may begin anywhere and be damaged.
class VnDecoder {
 public:
  struct Counts {
    std::int64_t lines = 0;
    std::int64_t corrupt = 0;  ///< wrong checksum
  };

  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us) {
    buffer_.add(bytes, arrival_us, byte_us);
  }

  /// The next complete line.
  std::optional<VnLine> next();

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Forgets what is not complete, after a change of the baud rate.
  void clear() { buffer_.clear(); }

 private:
  TimedBuffer buffer_;
  Counts counts_;
};

}  // namespace adit
