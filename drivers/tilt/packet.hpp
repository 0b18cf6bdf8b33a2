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

/// A status packet of the DYNAMIXEL protocol 2.0 (ROBOTIS e-manual, "DYNAMIXEL Protocol 2.0"): FFh,
/// FFh, FDh, 00h, id, length (low byte first) of what follows, instruction 55h, error, parameters,
/// CRC (low byte first). FDh is inserted behind each FFh FFh FDh from the instruction to the last
/// parameter.
struct DynamixelStatus {
  std::uint8_t id = 0;
  std::uint8_t error = 0;  ///< bit 7: alert, see the hardware error status; 0 to 6: error number
  std::vector<std::uint8_t> parameters;
  std::int64_t start_us = 0;  ///< arrival of the first byte, as passed to DynamixelDecoder::add
  std::int64_t end_us = 0;    ///< and of the last

  [[nodiscard]] bool alert() const { return (error & 0x80U) != 0; }
  [[nodiscard]] int error_number() const { return error & 0x7F; }
};

enum class DynamixelInstruction : std::uint8_t { kPing = 0x01, kRead = 0x02, kWrite = 0x03 };

/// CRC-16 of all bytes before it, from the header: polynomial 8005h, initial value 0, not
/// reflected.
std::uint16_t dynamixel_crc(std::span<const std::uint8_t> bytes);

/// An instruction packet.
std::vector<std::uint8_t> encode_instruction(std::uint8_t id, DynamixelInstruction instruction,
                                             std::span<const std::uint8_t> parameters);

/// Finds the status packets in a stream of bytes that may begin anywhere and be damaged.
/// Instruction packets, which some adapters echo, are passed over.
class DynamixelDecoder {
 public:
  struct Counts {
    std::int64_t packets = 0;
    std::int64_t corrupt = 0;  ///< wrong CRC
  };

  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us);

  /// The next complete status packet.
  std::optional<DynamixelStatus> next();

  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Forgets what is not complete, after a change of the baud rate.
  void clear() { buffer_.clear(); }

 private:
  TimedBuffer buffer_;
  double byte_us_ = 0.0;
  Counts counts_;
};

}  // namespace adit
