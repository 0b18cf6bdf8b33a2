// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/checks.hpp"

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

/// True if the matrix can be a covariance or information matrix: finite, symmetric within rounding,
/// and off-diagonal entries bounded by the variances. Zero is valid: no information.
inline bool is_information_matrix(const double (&rows)[3][3]) {
  constexpr double kRounding = 1e-6;  // relative; matrices result from products and inverses
  for (int i = 0; i < 3; ++i) {
    if (!all_finite(rows[i]) || rows[i][i] < 0.0) return false;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double bound = std::sqrt(rows[i][i]) * std::sqrt(rows[j][j]);
      if (std::abs(rows[i][j]) > (1.0 + kRounding) * bound) return false;
      if (std::abs(rows[i][j] - rows[j][i]) > kRounding * bound) return false;
    }
  }
  return true;
}

constexpr const char* kPoseNotFinite = "pose is not finite";
constexpr const char* kInvalidInformation = "invalid information matrix";
constexpr const char* kImplausibleAttitude = "roll or pitch beyond 60 degrees";
inline constexpr double kAttitudeMaxRad = deg_to_rad(60.0);

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
/// Whether the angles are those of a vehicle that stands on its wheels.
template <class Message>
bool is_plausible_attitude(const Message& message) {
  return std::abs(message.roll_rad) < kAttitudeMaxRad &&
         std::abs(message.pitch_rad) < kAttitudeMaxRad;  // NaN fails too
}

}  // namespace adit
