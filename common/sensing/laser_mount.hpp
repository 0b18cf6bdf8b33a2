// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// Extrinsics and valid range of a planar laser. The laser may be tilted about an axis parallel to
/// its own y axis.
struct LaserMount {
  Pose2 T_body_laser;         ///< pose of the level laser in the body frame [m, rad]
  double height_m = 0.0;      ///< height of the level laser above the origin of the body frame
  double lever_x_m = 0.0;     ///< distance of the laser ahead of the tilt axis, when level
  double lever_z_m = 0.0;     ///< height of the laser above the tilt axis, when level
  double range_min_m = 0.1;   ///< shorter readings are invalid (dirt on the window, no reading)
  double range_max_m = 50.0;  ///< readings at or beyond are no-returns

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

/// Pose of the laser in the body frame at a tilt angle [rad]; positive tilts the laser downwards.
Eigen::Isometry3d tilted_laser(const LaserMount& mount, double tilt_rad);

/// The lasers of the vehicle: a configuration section that all stages share, so that all use the
/// same extrinsics.
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
