// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A rigid motion in space that keeps the vertical, an element of SE(2) × R. Frames whose z axis is
/// opposite to gravity are related by it; neighbours cancel as in Pose2.
struct LevelPose {
  Pose2 plan;
  double z_m = 0.0;  ///< height

  [[nodiscard]] Eigen::Vector3d translation() const { return {plan.x, plan.y, z_m}; }

  [[nodiscard]] LevelPose inverse() const { return {plan.inverse(), -z_m}; }

  friend LevelPose operator*(const LevelPose& T_a_b, const LevelPose& T_b_c) {
    return {T_a_b.plan * T_b_c.plan, T_a_b.z_m + T_b_c.z_m};
  }

  /// Transforms a point from b to a.
  friend Eigen::Vector3d operator*(const LevelPose& T_a_b, const Eigen::Vector3d& p_b) {
    const Eigen::Vector2d p_plan = T_a_b.plan * Eigen::Vector2d(p_b.head<2>());
    return {p_plan.x(), p_plan.y(), T_a_b.z_m + p_b.z()};
  }

  friend bool operator==(const LevelPose&, const LevelPose&) = default;
};

/// The pose of b in the frame of a: `T_a_b` from `T_w_a` and `T_w_b`.
inline LevelPose between(const LevelPose& T_w_a, const LevelPose& T_w_b) {
  return T_w_a.inverse() * T_w_b;
}

}  // namespace adit
