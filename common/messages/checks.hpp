// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace adit {

/// True for a time from 1970 to 2286, so that differences of times do not overflow.
inline bool is_plausible_utime(std::int64_t utime) {
  constexpr std::int64_t kEnd = 10'000'000'000'000'000;
  return utime >= 0 && utime < kEnd;
}

/// True if no number of the array is NaN or infinite.
template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](double number) { return std::isfinite(number); });
}

/// True for a number from 0 to 1; false for NaN.
inline bool is_share(double number) { return number >= 0.0 && number <= 1.0; }

/// True for a finite, non-negative length.
inline bool is_distance(double distance_m) {
  return std::isfinite(distance_m) && distance_m >= 0.0;
}

constexpr const char* kShareOutOfRange = "share outside 0 to 1";
constexpr const char* kImplausibleTime = "time outside 1970 to 2286";

}  // namespace adit
