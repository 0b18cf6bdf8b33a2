// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/vehicle/vehicle.hpp"

namespace adit {

/// What a scan says of things that the vehicle would run into.
struct LaserPoints {
  /// In the body frame, one for each beam, in their order; NaN where there is nothing to run into.
  std::vector<Eigen::Vector2d> p_body;
  int returns = 0;  ///< beams that came back at all, with a range that is to be believed
};

/// Places a scan on the body. What is at most one step above the ground is ground, and what is
/// above the highest point of the vehicle is roof, by the plane under its wheels or by that which
/// is level
/// (`up_body`): the first is right on a slope, the second while a wheel is on a rail. Where both
/// allow it, a point is an obstacle.
LaserPoints place_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                       const Eigen::Vector3d& up_body, const Vehicle& vehicle);

}  // namespace adit
