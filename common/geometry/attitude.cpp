// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/attitude.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

Eigen::Matrix3d Attitude::rotation() const {
  return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d Attitude::up_body() const { return rotation().row(2).transpose(); }

Attitude Attitude::from_up(const Eigen::Vector3d& up_body) {
  const Eigen::Vector3d up = up_body.normalized();
  return {std::atan2(up.y(), up.z()), -std::asin(std::clamp(up.x(), -1.0, 1.0))};
}

double heading_rate_rad_s(const Attitude& attitude, const Eigen::Vector3d& angular_velocity) {
  return (angular_velocity.y() * std::sin(attitude.roll_rad) +
          angular_velocity.z() * std::cos(attitude.roll_rad)) /
         std::max(std::cos(attitude.pitch_rad), 0.1);
}

Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m, const Attitude& attitude) {
  Eigen::Isometry3d T = in_space(T_a_b, z_m);
  if (!attitude.is_level()) T.linear() = T.linear() * attitude.rotation();
  return T;
}

Eigen::Vector2d ground_slope(const Attitude& attitude) {
  const Eigen::Vector3d normal = attitude.rotation().col(2);
  return -normal.head<2>() / std::max(normal.z(), 0.1);
}

}  // namespace adit
