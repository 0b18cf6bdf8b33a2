// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

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
bool is_information_matrix(const double (&rows)[3][3]);

constexpr const char* kPoseNotFinite = "pose is not finite";
constexpr const char* kInvalidInformation = "invalid information matrix";

}  // namespace adit
