// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/laser_points.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace adit {
namespace {

const Eigen::Vector2d kNothing =
    Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

bool is_return(double range_m, const LaserMount& mount) {
  return range_m >= mount.range_min_m && range_m < mount.range_max_m;  // not of NaN
}

bool is_in_the_way(double height_m, const Vehicle& vehicle) {
  return height_m > vehicle.step_max_m && height_m < vehicle.height_m;
}

}  // namespace

LaserPoints place_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                       const Eigen::Vector3d& up_body, const Vehicle& vehicle) {
  const Eigen::Isometry3d T_body_laser = tilted_laser(mount, tilt_rad);
  LaserPoints points;
  points.p_body.assign(scan.ranges_m.size(), kNothing);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!is_return(range_m, mount)) continue;
    ++points.returns;
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Eigen::Vector3d p_laser(range_m * std::cos(bearing), range_m * std::sin(bearing), 0.0);
    const Eigen::Vector3d p = T_body_laser * p_laser;
    if (!is_in_the_way(p.z(), vehicle) || !is_in_the_way(up_body.dot(p), vehicle)) continue;
    points.p_body[i] = p.head<2>();
  }
  return points;
}

}  // namespace adit
