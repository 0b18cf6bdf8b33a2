// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/free_space.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/bearing.hpp"

namespace adit {
namespace {

/// Half of the height over which a wall that one beam hits is expected to stop another.
constexpr double kSameHeightM = 0.3;

/// T_body_laser in plan, and the height of the laser above the origin of the body frame.
struct LevelLaser {
  Pose2 T_body_laser;
  double height_m = 0.0;
};

LevelLaser level_laser(const LaserMount& mount, const Eigen::Matrix3d& R_level_body) {
  const Pose2& T = mount.T_body_laser;
  const Eigen::Vector3d p = R_level_body * Eigen::Vector3d(T.x, T.y, mount.height_m);
  const Eigen::Vector3d ahead =
      R_level_body * Eigen::Vector3d(std::cos(T.theta), std::sin(T.theta), 0.0);
  return {{p.x(), p.y(), std::atan2(ahead.y(), ahead.x())}, p.z()};
}

float largest(const std::vector<float>& values) {
  return values.empty() ? 0.0F : *std::max_element(values.begin(), values.end());
}

}  // namespace

FreeSpace::FreeSpace(const LaserScan& scan, const LaserMount& mount, const Attitude& attitude,
                     double z_m)
    : T_laser_body_(mount.T_body_laser.inverse()),
      angle_min_(scan.angle_min_rad),
      angle_step_(scan.angle_step_rad),
      z_laser_m_(z_m + mount.height_m) {
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
  if (attitude.is_level()) {
    reach_m_ = largest(free_m_);
    return;
  }
  const Eigen::Matrix3d R_level_body = attitude.rotation();
  const LevelLaser laser = level_laser(mount, R_level_body);
  T_laser_body_ = laser.T_body_laser.inverse();
  z_laser_m_ = z_m + laser.height_m;
  rise_ = Eigen::Rotation2Dd(-laser.T_body_laser.theta) * ground_slope(attitude);
  // The bearing of a beam changes by less than its width; its horizontal length does not.
  for (std::size_t i = 0; i < free_m_.size(); ++i) {
    const double bearing = angle_min_ + static_cast<double>(i) * angle_step_;
    const Eigen::Vector2d ahead(std::cos(bearing), std::sin(bearing));
    free_m_[i] /= static_cast<float>(std::hypot(1.0, rise_.dot(ahead)));
  }
  reach_m_ = largest(free_m_);
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
    count += inside(p_laser, point.z_m, margin) ? 1 : 0;
  }
  return count;
}

bool FreeSpace::inside(const Eigen::Vector2d& p_laser, double z_m, double margin) const {
  const double reach = reach_m_ - margin;
  const double squared = p_laser.squaredNorm();
  if (!(reach > 0.0 && squared < reach * reach)) return false;
  const double beam = std::floor((bearing_of(p_laser) - angle_min_) / angle_step_ + 0.5);
  if (!(beam >= 0.0 && beam < static_cast<double>(free_m_.size()))) return false;
  const double free = free_m_[static_cast<std::size_t>(beam)] - margin;
  if (!(free > 0.0 && squared < free * free)) return false;
  return !(std::abs(z_m - z_laser_m_ - rise_.dot(p_laser)) > kSameHeightM);  // NaN is inside
}

}  // namespace adit
