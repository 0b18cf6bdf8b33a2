// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A pose as it is in the plan: seen from above, heading where its x axis points.
inline Pose2 in_plan(const Eigen::Isometry3d& T_a_b) {
  const auto& R = T_a_b.linear();
  return {T_a_b.translation().x(), T_a_b.translation().y(), std::atan2(R(1, 0), R(0, 0))};
}

/// A pose of the plan, level, at a height [m].
inline Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m = 0.0) {
  return Eigen::Translation3d(T_a_b.x, T_a_b.y, z_m) *
         Eigen::AngleAxisd(T_a_b.theta, Eigen::Vector3d::UnitZ());
}

}  // namespace adit
