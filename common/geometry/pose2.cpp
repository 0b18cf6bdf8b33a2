// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/pose2.hpp"

namespace adit {

Eigen::Isometry3d in_space(const Pose2& T_a_b, double z_m) {
  return Eigen::Translation3d(T_a_b.x, T_a_b.y, z_m) *
         Eigen::AngleAxisd(T_a_b.theta, Eigen::Vector3d::UnitZ());
}

}  // namespace adit
