// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"

namespace adit {

/// The laser that measured a scan.
enum class LaserId { kFront, kRear };

inline LaserId other(LaserId laser) {
  return laser == LaserId::kFront ? LaserId::kRear : LaserId::kFront;
}

/// One scan of a planar laser, unfiltered, as the driver delivers it. Beam i points at
/// `angle_min_rad + i * angle_step_rad`, counter-clockwise from the laser's x axis, in the laser
/// frame.
struct LaserScan {
  std::int64_t utime = 0;       ///< time of measurement [µs since the epoch]
  std::vector<float> ranges_m;  ///< [m]; may contain NaN, 0 and no-return values
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;

  friend bool operator==(const LaserScan&, const LaserScan&) = default;
};

/// Time at which each beam of a scan is measured. A SICK LMS-200 turns its mirror at 75 Hz and
/// measures one beam per degree. A scan at half a degree takes two turns: the even beams in the
/// first, the odd beams in the second. A Hokuyo UTM-30LX measures all beams in one turn at 40 Hz.
struct ScanTiming {
  double mirror_hz = 75.0;
  /// Mirror turns per scan, of which each measures every n-th beam. 0: those of a SICK LMS-200.
  int mirror_turns = 0;
  /// The beams are measured from the last to the first, as by a lidar that turns clockwise.
  bool clockwise = false;

  template <class V>
  void visit(V& v) {
    v("mirror_hz", mirror_hz, above(0.0));
    v("turns", mirror_turns, within(0, 8));
    v("clockwise", clockwise);
  }

  /// Mirror turns per scan: as configured, or 2 where beams are less than 0.75° apart.
  [[nodiscard]] int turns(double angle_step_rad) const;
  /// Time from the first beam of a scan to the first beam of the next [s].
  [[nodiscard]] double scan_period_s(double angle_step_rad) const;
  /// Time of one of so many beams relative to that measured first, LaserScan::utime [s].
  [[nodiscard]] double beam_time_s(int beam, int beams, double angle_step_rad) const;
  /// The same of the beam measured last; 0 without beams.
  [[nodiscard]] double last_beam_time_s(int beams, double angle_step_rad) const;
};

}  // namespace adit
