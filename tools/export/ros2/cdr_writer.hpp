// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/files/little_endian.hpp"

namespace adit {

/// Appends the fields of a message in plain CDR, little-endian (OMG DDSI-RTPS 2.3, section 10), as
/// ROS 2 serializes its messages.
class CdrWriter {
 public:
  CdrWriter() : bytes_("\x00\x01\x00\x00", kEncapsulationBytes) {}

  CdrWriter& u8(std::uint8_t value) { return number(value, 1); }
  CdrWriter& i32(std::int32_t value) { return number(static_cast<std::uint32_t>(value), 4); }
  CdrWriter& u32(std::size_t value) { return number(value, 4); }
  CdrWriter& f32(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }
  CdrWriter& f64(double value) { return number(std::bit_cast<std::uint64_t>(value), 8); }
  CdrWriter& text(std::string_view value) {
    u32(value.size() + 1);
    bytes_ += value;
    bytes_ += '\0';
    return *this;
  }
  /// A sequence of bytes.
  CdrWriter& bytes(std::string_view value) {
    u32(value.size());
    bytes_ += value;
    return *this;
  }
  /// A time, and std_msgs/Header.
  CdrWriter& time(std::int64_t utime) {
    i32(static_cast<std::int32_t>(utime / 1'000'000));
    return u32(static_cast<std::size_t>(utime % 1'000'000 * 1000));
  }
  CdrWriter& header(std::int64_t utime, std::string_view frame) { return time(utime).text(frame); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kEncapsulationBytes = 4;  // alignment counts from behind it

  CdrWriter& number(std::uint64_t value, std::size_t size) {
    while ((bytes_.size() - kEncapsulationBytes) % size != 0) bytes_ += '\0';
    append_little_endian(bytes_, value, size);
    return *this;
  }

  std::string bytes_;
};

}  // namespace adit
