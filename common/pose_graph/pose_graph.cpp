// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/pose_graph.hpp"

#include <cmath>

namespace adit {

Eigen::Vector3d residual(const PoseConstraint& constraint, const Pose2& T_map_from,
                         const Pose2& T_map_to) {
  // Eq. 3, in the measurement frame.
  return between(constraint.T_from_to, between(T_map_from, T_map_to)).vector();
}

double energy(const PoseConstraint& constraint, const Eigen::Vector3d& e) {
  return e.dot(constraint.information * e);
}

double objective(const PoseGraph& graph) {
  double sum = 0.0;
  for (const PoseConstraint& c : graph.constraints) {
    const auto from = static_cast<std::size_t>(c.from);
    const auto to = static_cast<std::size_t>(c.to);
    sum += energy(c, residual(c, graph.poses[from], graph.poses[to]));
  }
  return sum;
}

Eigen::Matrix3d LinearPotential::jacobian_from() const {
  Eigen::Matrix3d J = -J_to;
  J.topRightCorner<2, 1>() -= J_to.topLeftCorner<2, 2>() * lever;
  return J;
}

LinearPotential linearise(const PoseConstraint& constraint, const Pose2& T_map_from,
                          const Pose2& T_map_to) {
  const Pose2& z = constraint.T_from_to;
  const double cos_z = std::cos(z.theta);
  const double sin_z = std::sin(z.theta);
  const double cos_from = std::cos(T_map_from.theta);
  const double sin_from = std::sin(T_map_from.theta);
  const double c = cos_from * cos_z - sin_from * sin_z;
  const double s = sin_from * cos_z + cos_from * sin_z;
  const Eigen::Vector2d d = T_map_to.translation() - T_map_from.translation();

  LinearPotential potential;  // eq. 5, in the measurement frame
  potential.e << c * d.x() + s * d.y() - cos_z * z.x - sin_z * z.y,
      -s * d.x() + c * d.y() + sin_z * z.x - cos_z * z.y,
      wrap_angle(T_map_to.theta - T_map_from.theta - z.theta);
  potential.J_to << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  potential.lever << -d.y(), d.x();
  return potential;
}

}  // namespace adit
