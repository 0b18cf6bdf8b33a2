// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Where a planar laser sits on the body and which of its readings are to be believed. The laser
/// may be tilted about an axis along its own y axis.
struct LaserMount {
  Pose2 T_body_laser;         ///< pose of the level laser in the body frame [m, rad]
  double height_m = 0.0;      ///< of the level laser above the body's origin
  double lever_x_m = 0.0;     ///< of the laser ahead of the axis of tilt, when level
  double lever_z_m = 0.0;     ///< of the laser above the axis of tilt, when level
  double range_min_m = 0.1;   ///< a reading below is dirt on the window or no reading
  double range_max_m = 50.0;  ///< a reading at or beyond is no return

  template <class V>
  void visit(V& v) {
    v("T_body_laser", T_body_laser);
    v("height_m", height_m);
    v("lever_x_m", lever_x_m);
    v("lever_z_m", lever_z_m);
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_max_m", range_max_m, above(0.0));
  }
};

/// Pose of the laser in the body frame when its mount is tilted [rad], positive looking down.
Eigen::Isometry3d tilted_laser(const LaserMount& mount, double tilt_rad);

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
