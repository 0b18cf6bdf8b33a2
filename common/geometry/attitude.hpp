// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  [[nodiscard]] Eigen::Matrix3d rotation() const;
  /// The vertical in the body frame, a unit vector.
  [[nodiscard]] Eigen::Vector3d up_body() const;

  /// From the vertical in the body frame, which need not be a unit vector.
  [[nodiscard]] static Attitude from_up(const Eigen::Vector3d& up_body);

  friend bool operator==(const Attitude&, const Attitude&) = default;
};

/// Rate of the heading [rad/s] of a body that turns with this angular velocity in its own frame
/// [rad/s]: a body that leans and pitches turns about the vertical as well (Euler rates of Z, Y, X;
/// Diebel, "Representing attitude", 2006). Bounded near a pitch of 90 degrees.
double heading_rate_rad_s(const Attitude& attitude, const Eigen::Vector3d& angular_velocity);

/// A pose in six degrees of freedom from a planar pose, a height [m] and an attitude.
Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m, const Attitude& attitude);

/// The slope of the plane on which the body stands, along x and y of level: its height rises by
/// slope · p [m/m].
Eigen::Vector2d ground_slope(const Attitude& attitude);

}  // namespace adit
