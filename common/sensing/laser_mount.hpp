// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Extrinsics, field of view, timing and valid range of a planar laser. The laser may be tilted
/// about an axis parallel to its own y axis.
struct LaserMount {
  Pose2 T_body_laser;         ///< pose of the level laser in the body frame [m, rad]
  double height_m = 0.0;      ///< height of the level laser above the origin of the body frame
  double lever_x_m = 0.0;     ///< distance of the laser ahead of the tilt axis, when level
  double lever_z_m = 0.0;     ///< height of the laser above the tilt axis, when level
  double range_min_m = 0.1;   ///< shorter readings are invalid (dirt on the window, no reading)
  double range_max_m = 50.0;  ///< readings at or beyond are no-returns
  double field_of_view_rad =
      std::numbers::pi;  ///< between first and last beam, x axis in its middle
  ScanTiming timing{};

  template <class V>
  void visit(V& v) {
    v("T_body_laser", T_body_laser);
    v("height_m", height_m);
    v("lever_x_m", lever_x_m);
    v("lever_z_m", lever_z_m);
    v("range_min_m", range_min_m, at_least(0.0));
    v("range_max_m", range_max_m, above(0.0));
    v("field_of_view_rad", field_of_view_rad, above_up_to(0.0, 2.0 * std::numbers::pi));
    v("timing", timing);
  }
};

/// Pose of the laser in the body frame at a tilt angle [rad]; positive tilts the laser downwards.
Eigen::Isometry3d tilted_laser(const LaserMount& mount, double tilt_rad);

/// The lasers of the vehicle: a configuration section that all stages share, so that all use the
/// same extrinsics. A vehicle with one laser has no rear one, and is blind behind.
struct Lasers {
  static constexpr const char* kSection = "lasers";

  LaserMount front;
  LaserMount rear{.T_body_laser = {0.0, 0.0, std::numbers::pi}};
  int count = 2;  ///< 1: the front laser only

  [[nodiscard]] bool has_rear() const { return count == 2; }
  [[nodiscard]] const LaserMount& of(LaserId laser) const {
    return laser == LaserId::kFront ? front : rear;
  }

  template <class V>
  void visit(V& v) {
    v("count", count, within(1, 2));
    v("front", front);
    v("rear", rear);
  }
};

}  // namespace adit
