// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/normal_equations.hpp"

#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

/// How much of the gradient is left after a small share `h` of Newton's step, beyond the share 1 −
/// h that is left if the matrix is the derivative of the gradient.
double error_of_derivative(PoseGraph graph, double curvature_share, double h) {
  const GraphStructure structure = analyse(graph);
  NormalEquations equations(structure);
  equations.linearise_with_curvature(graph, curvature_share);
  if (!equations.matrix().factorise()) return 1.0;
  const Eigen::VectorXd b = equations.b();
  move_poses(h * equations.matrix().solve(b), graph.poses);
  equations.linearise_gradient(graph);
  return (equations.b() - (1.0 - h) * b).norm() / (h * b.norm());
}

TEST(NormalEquations, WithCurvatureAreTheSecondDerivative) {
  PoseGraph graph = test::square_trajectory_graph(60, 5, 0.1);
  optimize(graph, {});
  for (std::size_t i = 1; i < graph.poses.size(); ++i) {
    const auto k = static_cast<double>(i);
    graph.poses[i] = graph.poses[i] *
                     Pose2{0.1 * std::sin(k), 0.1 * std::cos(2.0 * k), 0.05 * std::sin(3.0 * k)};
  }
  EXPECT_LT(error_of_derivative(graph, 1.0, 1e-6), 1e-4);  // first order in the step
  EXPECT_GT(error_of_derivative(graph, 0.0, 1e-6), 1e-3);
}

}  // namespace
}  // namespace adit
