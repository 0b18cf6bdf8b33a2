// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/messages/checks.hpp"

/// Planar poses and 3×3 matrices as they stand in messages: (x, y, θ), row by row.
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

/// Whether a matrix may be a covariance or the inverse of one: finite, symmetric but for rounding,
/// and no variance or covariance beyond what that allows. Zero is one: nothing is known.
bool is_information_matrix(const double (&rows)[3][3]);

constexpr const char* kPoseNotFinite = "pose is not finite";
constexpr const char* kInvalidInformation = "no information matrix";

}  // namespace adit
