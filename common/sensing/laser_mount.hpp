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

/// A spinning 3D lidar. It stands where the front laser is described, with the same range limits,
/// and replaces it: the front laser is its level view.
struct LidarMount {
  bool present = false;
  double pitch_rad = 0.0;  ///< of its axis about the y axis of the front laser; positive looks down
  int level_beams = 900;   ///< of its level view, over a turn

  template <class V>
  void visit(V& v) {
    v("present", present);
    v("pitch_rad", pitch_rad, within(-0.8, 0.8));
    v("level_beams", level_beams, within(90, 4096));
  }
};

/// The lasers of the vehicle: a configuration section that all stages share, so that all use the
/// same extrinsics. A vehicle with one laser has no rear one, and is blind behind unless that is
/// the level view of a spinning lidar.
struct Lasers {
  static constexpr const char* kSection = "lasers";

  LaserMount front;
  LaserMount rear{.T_body_laser = {0.0, 0.0, std::numbers::pi}};
  int count = 2;  ///< 1: the front laser only
  LidarMount lidar{};

  [[nodiscard]] bool has_rear() const { return count == 2; }
  /// Whether a scan shows what is behind the vehicle.
  [[nodiscard]] bool sees_behind() const { return has_rear() || lidar.present; }
  [[nodiscard]] const LaserMount& of(LaserId laser) const {
    return laser == LaserId::kFront ? front : rear;
  }

  template <class V>
  void visit(V& v) {
    v("count", count, within(1, 2));
    v("front", front);
    v("rear", rear);
    v("lidar", lidar);
  }
};

/// Pose of the spinning lidar in the body frame; its z axis is the axis of rotation.
Eigen::Isometry3d T_body_lidar(const Lasers& lasers);

}  // namespace adit
