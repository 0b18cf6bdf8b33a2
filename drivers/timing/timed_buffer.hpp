// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace adit {

/// Bytes of a stream that are not decoded yet, with their times of arrival.
class TimedBuffer {
 public:
  /// Bytes that arrived at this time [µs], the last of them; a byte takes `byte_us` on the line.
  void add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us, double byte_us);

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  /// Removes bytes from the front.
  void drop(std::size_t count);
  void clear();

  /// Arrival of the byte before `end` [µs]: of its read, minus the bytes behind it on the line.
  [[nodiscard]] std::int64_t end_us(std::size_t end) const;

 private:
  struct Arrival {
    std::size_t end = 0;  ///< number of bytes in the buffer up to here
    std::int64_t utime = 0;
  };

  std::vector<std::uint8_t> bytes_;
  std::deque<Arrival> arrivals_;
  double byte_us_ = 0.0;
};

}  // namespace adit
