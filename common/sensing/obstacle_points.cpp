// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/obstacle_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace adit {
namespace {

const Eigen::Vector2d kNothing =
    Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

bool is_return(double range_m, const LaserMount& mount) {
  return range_m >= mount.range_min_m && range_m < mount.range_max_m;  // false for NaN
}

/// The share of a line, from its begin on, that lies among the heights [0, 1].
double share_among(double begin_m, double end_m, const ObstacleHeights& heights) {
  if (!(begin_m > heights.min_m && begin_m < heights.max_m)) return 0.0;
  if (end_m <= heights.min_m) return (begin_m - heights.min_m) / (begin_m - end_m);
  if (end_m >= heights.max_m) return (heights.max_m - begin_m) / (end_m - begin_m);
  return 1.0;
}

bool is_among(double height_m, const ObstacleHeights& heights) {
  return height_m > heights.min_m && height_m < heights.max_m;
}

}  // namespace

LaserPoints project_scan(const LaserScan& scan, const LaserMount& mount, double tilt_rad,
                         const Eigen::Vector3d& up_body, const ObstacleHeights& heights) {
  const Eigen::Isometry3d T_body_laser = tilted_laser(mount, tilt_rad);
  LaserPoints points;
  const Eigen::Vector3d p_begin = T_body_laser.translation();
  points.p_body.assign(scan.ranges_m.size(), kNothing);
  points.p_body_free.assign(scan.ranges_m.size(), kNothing);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!is_return(range_m, mount)) continue;
    ++points.returns;
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Eigen::Vector3d p_laser(range_m * std::cos(bearing), range_m * std::sin(bearing), 0.0);
    const Eigen::Vector3d p = T_body_laser * p_laser;
    if (is_among(p.z(), heights) && is_among(up_body.dot(p), heights))
      points.p_body[i] = p.head<2>();
    const double share = std::min(share_among(p_begin.z(), p.z(), heights),
                                  share_among(up_body.dot(p_begin), up_body.dot(p), heights));
    points.p_body_free[i] = (p_begin + share * (p - p_begin)).head<2>();
  }
  return points;
}

}  // namespace adit
