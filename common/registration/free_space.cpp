// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

FreeSpace::FreeSpace(const LaserScan& scan, const LaserMount& mount)
    : T_laser_body_(mount.T_body_laser.inverse()),
      angle_min_(scan.angle_min_rad),
      angle_step_(scan.angle_step_rad) {
  std::vector<float> valid_m(scan.ranges_m.size(), 0.0F);
  for (std::size_t i = 0; i < valid_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (range >= mount.range_min_m && range < mount.range_max_m) valid_m[i] = scan.ranges_m[i];
  }
  free_m_ = valid_m;
  for (std::size_t i = 0; i < valid_m.size(); ++i) {
    if (i > 0) free_m_[i] = std::min(free_m_[i], valid_m[i - 1]);
    if (i + 1 < valid_m.size()) free_m_[i] = std::min(free_m_[i], valid_m[i + 1]);
  }
}

int FreeSpace::count_inside(const std::vector<SurfacePoint>& points, const Pose2& T_body_points,
                            double margin) const {
  const Pose2 T_laser_points = T_laser_body_ * T_body_points;
  const double c = std::cos(T_laser_points.theta);
  const double s = std::sin(T_laser_points.theta);
  int count = 0;
  for (const auto& point : points) {
    const Eigen::Vector2d p_laser(c * point.p.x() - s * point.p.y() + T_laser_points.x,
                                  s * point.p.x() + c * point.p.y() + T_laser_points.y);
    count += inside(p_laser, margin) ? 1 : 0;
  }
  return count;
}

bool FreeSpace::inside(const Eigen::Vector2d& p_laser, double margin) const {
  const double bearing = std::atan2(p_laser.y(), p_laser.x());
  const double beam = std::floor((bearing - angle_min_) / angle_step_ + 0.5);
  if (!(beam >= 0.0 && beam < static_cast<double>(free_m_.size()))) return false;
  const double free = free_m_[static_cast<std::size_t>(beam)] - margin;
  return free > 0.0 && p_laser.squaredNorm() < free * free;
}

}  // namespace adit
