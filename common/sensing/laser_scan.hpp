// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"

namespace adit {

/// Which laser of the body a scan is from.
enum class LaserId { kFront, kRear };

inline LaserId other(LaserId laser) {
  return laser == LaserId::kFront ? LaserId::kRear : LaserId::kFront;
}

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

/// When the beams of one scan are measured. A SICK LMS-200 turns its mirror at 75 Hz and measures a
/// beam for each degree. For a scan at half a degree it takes two turns: the even beams in the
/// first, those between them in the second.
struct ScanTiming {
  double mirror_hz = 75.0;

  template <class V>
  void visit(V& v) {
    v("mirror_hz", mirror_hz, above(0.0));
  }

  /// Turns of the mirror that a scan takes: 2 where beams are less than 0.75° apart.
  [[nodiscard]] int turns(double angle_step_rad) const;
  /// From the first beam to the first of the next scan [s].
  [[nodiscard]] double scan_period_s(double angle_step_rad) const;
  /// Of the beam, after the first of the scan, which is LaserScan::utime [s].
  [[nodiscard]] double beam_time_s(int beam, double angle_step_rad) const;
};

}  // namespace adit
