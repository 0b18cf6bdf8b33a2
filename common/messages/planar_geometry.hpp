// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"

/// Planar poses (x, y, θ) and row-major 3×3 matrices in messages.
namespace adit {

inline void set_pose(const Pose2& pose, double (&numbers)[3]) {
  numbers[0] = pose.x;
  numbers[1] = pose.y;
  numbers[2] = pose.theta;
}

inline Pose2 pose_from(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

inline void set_matrix(const Eigen::Matrix3d& matrix, double (&rows)[3][3]) {
  Eigen::Map<RowMajor3d> target(rows[0]);
  target = matrix;
}

inline Eigen::Matrix3d matrix_from(const double (&rows)[3][3]) {
  return Eigen::Map<const RowMajor3d>(rows[0]);
}

/// Fields has_attitude, roll_rad and pitch_rad of a message. `from_ground`: not measured by an IMU.
template <class Message>
void set_attitude(const std::optional<Attitude>& attitude, bool from_ground, Message& message) {
  message.has_attitude = static_cast<std::int8_t>(attitude.has_value() && !from_ground);
  message.roll_rad = attitude ? attitude->roll_rad : 0.0;
  message.pitch_rad = attitude ? attitude->pitch_rad : 0.0;
}
template <class Message>
std::optional<Attitude> attitude_from(const Message& message) {
  const Attitude attitude{message.roll_rad, message.pitch_rad};
  if (message.has_attitude == 0 && attitude.is_level()) return std::nullopt;
  return attitude;
}

}  // namespace adit
