// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Where a planar laser sits on the body and which of its readings are to be believed.
struct LaserMount {
  Pose2 T_body_laser;         ///< pose of the laser in the body frame [m, rad]
  double range_min_m = 0.1;   ///< a reading below is dirt on the window or no reading
  double range_max_m = 50.0;  ///< a reading at or beyond is no return

  template <class V>
  void visit(V& v) {
    v("T_body_laser", T_body_laser);
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_max_m", range_max_m, above(0.0));
  }
};

/// The lasers of the vehicle: a section of the configuration that all stages share, so that none
/// can have them elsewhere than another.
struct Lasers {
  static constexpr const char* kSection = "lasers";

  LaserMount front;
  LaserMount rear{.T_body_laser = {0.0, 0.0, std::numbers::pi}};

  template <class V>
  void visit(V& v) {
    v("front", front);
    v("rear", rear);
  }
};

}  // namespace adit
