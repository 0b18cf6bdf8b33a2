// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Roll and pitch of the body: its rotation against the frame level, which has the same heading and
/// a vertical z axis. R_level_body = R_y(pitch) · R_x(roll), as in REP 103: a positive pitch lowers
/// the front, a positive roll raises the left side.
struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;

  [[nodiscard]] bool is_level() const { return roll_rad == 0.0 && pitch_rad == 0.0; }
  /// R_level_body.
  [[nodiscard]] Eigen::Matrix3d rotation() const {
    return (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
  /// The vertical in the body frame, a unit vector.
  [[nodiscard]] Eigen::Vector3d up_body() const { return rotation().row(2).transpose(); }

  /// From the vertical in the body frame, which need not be a unit vector.
  [[nodiscard]] static Attitude from_up(const Eigen::Vector3d& up_body) {
    const Eigen::Vector3d up = up_body.normalized();
    return {std::atan2(up.y(), up.z()), -std::asin(std::clamp(up.x(), -1.0, 1.0))};
  }

  friend bool operator==(const Attitude&, const Attitude&) = default;
};

/// A pose in six degrees of freedom from a planar pose, a height [m] and an attitude.
inline Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m, const Attitude& attitude) {
  Eigen::Isometry3d T = in_space(T_a_b, z_m);
  if (!attitude.is_level()) T.linear() = T.linear() * attitude.rotation();
  return T;
}

/// The slope of the plane on which the body stands, along x and y of level: its height rises by
/// slope · p [m/m].
inline Eigen::Vector2d ground_slope(const Attitude& attitude) {
  const Eigen::Vector3d normal = attitude.rotation().col(2);
  return -normal.head<2>() / std::max(normal.z(), 0.1);
}

}  // namespace adit
