// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// Heights above the ground [m], exclusive, between which a point is an obstacle: lower it is
/// ground, at most one step high, and higher it is roof, above the vehicle.
struct ObstacleHeights {
  double min_m = 0.0;
  double max_m = 0.0;
};

/// The points of a scan at the height of obstacles.
struct LaserPoints {
  /// In the body frame, one for each beam in their order; NaN for beams without an obstacle.
  std::vector<Eigen::Vector2d> p_body;
  /// Likewise up to where each beam shows free space at the height of obstacles: its obstacle, or
  /// where it leaves these heights upwards or downwards; NaN without a valid range.
  std::vector<Eigen::Vector2d> p_body_free;
  int returns = 0;  ///< number of beams with a valid range
};

/// Projects a scan into the body frame. Heights are taken both above the plane of the wheels, which
/// is right on a slope, and along `up_body`, which is right while a wheel is on a rail: a point is
/// an obstacle if it is one by both.
LaserPoints project_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                         const Eigen::Vector3d& up_body, const ObstacleHeights& heights);

}  // namespace adit
