// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "common/config/bounds.hpp"

namespace adit {

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
