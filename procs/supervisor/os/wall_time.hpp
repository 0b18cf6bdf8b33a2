// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

namespace adit {

/// Processes live in the time of the world, whatever time a simulator says it is: this is the one
/// place in a stage where a clock is read, and nothing that is computed depends on it.

/// Of a clock that is never put back [µs].
inline std::int64_t steady_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// By the wall clock [µs since the epoch].
inline std::int64_t wall_utime() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace adit
