// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace adit {

/// Whether a time of the wire can be reckoned with: 1970 to 2286, so that differences fit.
inline bool is_plausible_utime(std::int64_t utime) {
  constexpr std::int64_t kEnd = 10'000'000'000'000'000;
  return utime >= 0 && utime < kEnd;
}

/// Whether no number of the array is NaN or infinite.
template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](double number) { return std::isfinite(number); });
}

/// Whether a number is a share of a whole; NaN is none.
inline bool is_share(double number) { return number >= 0.0 && number <= 1.0; }

/// Whether a number is the length of a way: finite and not negative.
inline bool is_distance(double distance_m) {
  return std::isfinite(distance_m) && distance_m >= 0.0;
}

constexpr const char* kShareOutOfRange = "share beyond 0 to 1";
constexpr const char* kImplausibleTime = "time outside of 1970 to 2286";

}  // namespace adit
