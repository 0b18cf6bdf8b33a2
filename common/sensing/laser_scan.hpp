// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace adit {

/// One sweep of a planar laser, as the driver delivers it: nothing removed, nothing repaired.
/// Beam i points at `angle_min_rad + i * angle_step_rad`, counter-clockwise from the laser's x
/// axis, in the laser's frame.
struct LaserScan {
  std::int64_t utime = 0;       ///< time of measurement [µs since the epoch]
  std::vector<float> ranges_m;  ///< [m]; anything may be in it: NaN, 0, no-return values
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;

  friend bool operator==(const LaserScan&, const LaserScan&) = default;
};

}  // namespace adit
