// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/rotation_initialization.hpp"

#include <gtest/gtest.h>

#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

TEST(RotationInitialization, FindsOrientationsOverManyTurns) {
  const PoseGraph graph = test::square_trajectory_graph(400, 10, 0.0);
  const std::vector<double> theta = solve_rotations(graph, analyse(graph));
  for (std::size_t i = 0; i < theta.size(); ++i) {
    EXPECT_NEAR(angle_diff(theta[i], graph.poses[i].theta), 0.0, 1e-9);
  }
}

TEST(RotationInitialization, IsIndependentOfTheGivenPoses) {
  PoseGraph a = test::square_trajectory_graph(100, 5, 0.1);
  PoseGraph b = a;
  for (std::size_t i = 1; i < b.poses.size(); ++i) b.poses[i] = {7.0, -3.0, 2.0};
  const GraphStructure structure = analyse(a);
  NormalEquations equations(structure);
  ASSERT_TRUE(initialize_from_rotations(a, structure, equations));
  ASSERT_TRUE(initialize_from_rotations(b, structure, equations));
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_LT(between(a.poses[i], b.poses[i]).vector().norm(), 1e-9);
  }
}

TEST(RotationInitialization, IsExactWithoutNoise) {
  PoseGraph graph = test::square_trajectory_graph(100, 5, 0.0);
  const std::vector<Pose2> truth = graph.poses;
  for (std::size_t i = 1; i < graph.poses.size(); ++i) graph.poses[i] = {};
  const GraphStructure structure = analyse(graph);
  NormalEquations equations(structure);
  ASSERT_TRUE(initialize_from_rotations(graph, structure, equations));
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(between(truth[i], graph.poses[i]).vector().norm(), 1e-9);
  }
}

}  // namespace
}  // namespace adit
