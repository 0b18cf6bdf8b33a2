// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

/// Dense reference for tests: H and b of the field linearised at the poses, without node 0, from
/// the definition.
struct DenseField {
  explicit DenseField(const PoseGraph& graph) {
    const auto n = 3 * static_cast<Eigen::Index>(graph.poses.size());
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
    for (const PoseConstraint& c : graph.constraints) {
      const LinearPotential potential = linearise(c, graph.poses[static_cast<std::size_t>(c.from)],
                                                  graph.poses[static_cast<std::size_t>(c.to)]);
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n);
      J.middleCols<3>(Eigen::Index{3} * c.from) = potential.jacobian_from();
      J.middleCols<3>(Eigen::Index{3} * c.to) = potential.J_to;
      full += J.transpose() * c.information * J;
      rhs -= J.transpose() * c.information * potential.e;
      constant += energy(c, potential.e);
    }
    H = full.bottomRightCorner(n - 3, n - 3);
    b = rhs.tail(n - 3);
  }

  Eigen::MatrixXd H;
  Eigen::VectorXd b;
  double constant = 0.0;  ///< the objective at the linearisation point
};

}  // namespace adit::test
