// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "tools/ros/messages/ros_messages.hpp"

namespace adit {

/// A laser that measures in a level plane, by its pose in the body.
struct LevelMount {
  LaserMount mount;          ///< pose and height; no lever arm, default ranges
  bool upside_down = false;  ///< beams run clockwise, seen from above

  /// Nothing if the plane of the laser is inclined by more than 10°.
  static std::optional<LevelMount> of(const Eigen::Isometry3d& T_body_laser);
};

/// The rate at which a laser turns, in which direction, of one that is not upside down. Nothing
/// where its messages have no time from beam to beam, or one that no laser has.
std::optional<ScanTiming> timing_of(const RosLaserScan& scan);

/// The scan in the order of our messages, counter-clockwise seen from above. Nothing for a scan
/// without beams, or with beams that no laser has (rejection_reason).
std::optional<LaserScan> level_scan(const RosLaserScan& scan, bool upside_down);

/// How a level scan is made of a 3D scan.
struct LevelSlice {
  double angle_step_rad = 0.25 * 3.14159265358979323846 / 180.0;
  double height_m = 0.1;  ///< points within this height of the sensor, or
  double elevation_rad =
      0.0261799;  ///< within this angle, 1.5°: the level ring of a VLP-16 is at 1°
};

/// A level scan of a whole turn from points in a level frame at the sensor, x forward [m]: the
/// nearest point of the slice at each bearing, NaN where there is none.
LaserScan level_scan(const std::vector<Eigen::Vector3f>& points, const LevelSlice& slice = {});

}  // namespace adit
