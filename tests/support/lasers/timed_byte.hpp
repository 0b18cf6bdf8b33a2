// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

namespace adit {

/// A byte on a line, and when its last bit arrives [µs].
struct TimedByte {
  std::int64_t utime = 0;
  std::uint8_t byte = 0;
};

/// Takes the bytes from the line that have arrived by this time.
inline std::vector<TimedByte> take_due(std::deque<TimedByte>& line, std::int64_t utime) {
  std::vector<TimedByte> due;
  for (; !line.empty() && line.front().utime <= utime; line.pop_front()) {
    due.push_back(line.front());
  }
  return due;
}

/// What a port at another baud rate receives.
inline void garble(std::vector<TimedByte>& bytes, std::mt19937& random) {
  for (TimedByte& byte : bytes) byte.byte = static_cast<std::uint8_t>(random());
}

}  // namespace adit
