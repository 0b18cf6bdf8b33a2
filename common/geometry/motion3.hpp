// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The matrix of the cross product v × ….
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// A motion in space as (x, y, z, rotation vector) [m, rad]; the angle is at most π.
Vector6d motion_of(const Eigen::Isometry3d& T);
/// The inverse of motion_of.
Eigen::Isometry3d isometry_of(const Vector6d& motion);

}  // namespace adit
