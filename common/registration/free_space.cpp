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
  std::vector<float> believed(scan.ranges_m.size(), 0.0F);
  for (std::size_t i = 0; i < believed.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (range >= mount.range_min_m && range < mount.range_max_m) believed[i] = scan.ranges_m[i];
  }
  free_m_ = believed;
  for (std::size_t i = 0; i < believed.size(); ++i) {
    if (i > 0) free_m_[i] = std::min(free_m_[i], believed[i - 1]);
    if (i + 1 < believed.size()) free_m_[i] = std::min(free_m_[i], believed[i + 1]);
  }
}

int FreeSpace::count_inside(const std::vector<SurfacePoint>& points, const Pose2& T_body_points,
                            double margin) const {
  const Pose2 T_laser_points = T_laser_body_ * T_body_points;
  const double c = std::cos(T_laser_points.theta);
  const double s = std::sin(T_laser_points.theta);
  const double beams = static_cast<double>(free_m_.size());
  int inside = 0;
  for (const auto& point : points) {
    const double x = c * point.p.x() - s * point.p.y() + T_laser_points.x;
    const double y = s * point.p.x() + c * point.p.y() + T_laser_points.y;
    const double beam = std::floor((std::atan2(y, x) - angle_min_) / angle_step_ + 0.5);
    if (!(beam >= 0.0 && beam < beams)) continue;
    const double free = free_m_[static_cast<std::size_t>(beam)] - margin;
    if (free > 0.0 && x * x + y * y < free * free) ++inside;
  }
  return inside;
}

}  // namespace adit
