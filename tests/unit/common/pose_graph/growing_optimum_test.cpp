// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/growing_optimum.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

/// A graph whose constraints among the first poses are there, and what belongs to further ones.
struct Parts {
  explicit Parts(const PoseGraph& complete, int first) {
    graph.poses.assign(complete.poses.begin(), complete.poses.begin() + first);
    for (const PoseConstraint& c : complete.constraints) {
      (std::max(c.from, c.to) < first ? graph.constraints : further).push_back(c);
    }
  }

  PoseGraph graph;
  std::vector<PoseConstraint> further;
};

/// The optimum of the complete graph by factorisation, without the one that grows.
PoseGraph optimum(PoseGraph graph) {
  EXPECT_TRUE(optimize(graph, {}).converged);
  return graph;
}

double difference(const PoseGraph& a, const PoseGraph& b) {
  double largest = a.poses.size() == b.poses.size() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.poses.size(), b.poses.size()); ++i) {
    largest = std::max(largest, between(a.poses[i], b.poses[i]).vector().norm());
  }
  return largest;
}

TEST(GrowingOptimum, IsThatOfAllConstraintsAfterEachRunWithoutAFactorisation) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const PoseGraph complete = test::square_trajectory_graph(1300, 20, 0.05, seed);
    GrowingOptimum growing(Parts(complete, 1200).graph);
    ASSERT_TRUE(growing.result().converged);
    for (const int poses : {1230, 1231, 1300}) {
      const auto have = static_cast<int>(growing.graph().poses.size());
      Parts target(complete, poses);
      std::vector<PoseConstraint> run;
      for (const PoseConstraint& c : target.graph.constraints) {
        if (std::max(c.from, c.to) >= have) run.push_back(c);
      }
      const OptimizeResult result = growing.add(poses - have, run);
      EXPECT_TRUE(result.converged);
      EXPECT_EQ(result.factorisations, 0);
      const PoseGraph expected = optimum(target.graph);
      EXPECT_LT(difference(growing.graph(), expected), 1e-5) << seed << ", " << poses;
      EXPECT_NEAR(result.objective, objective(expected), 1e-6 * result.objective);
      EXPECT_NEAR(result.objective, objective(growing.graph()), 1e-9 * result.objective);
    }
  }
}

TEST(GrowingOptimum, TakesConstraintsBetweenPosesOfTheGraphAndBothDirections) {
  PoseGraph complete = test::square_trajectory_graph(420, 20, 0.05, 3);
  for (std::size_t i = 0; i < complete.constraints.size(); i += 2) {
    PoseConstraint& c = complete.constraints[i];
    std::swap(c.from, c.to);
    c.T_from_to = c.T_from_to.inverse();
  }
  Parts parts(complete, 400);
  // Every fifth loop of the graph comes later.
  PoseGraph before = parts.graph;
  std::vector<PoseConstraint> later = parts.further;
  before.constraints.clear();
  for (std::size_t i = 0; i < parts.graph.constraints.size(); ++i) {
    const PoseConstraint& c = parts.graph.constraints[i];
    (test::is_loop(c) && i % 5 == 0 ? later : before.constraints).push_back(c);
  }
  GrowingOptimum growing(before);
  const OptimizeResult result = growing.add(20, later);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(difference(growing.graph(), optimum(complete)), 1e-5);
}

TEST(GrowingOptimum, OptimizesTheCompleteGraphWhereARunBendsIt) {
  // A chain of odometry alone: the first loop moves it by metres.
  PoseGraph chain = test::square_trajectory_graph(300, 20, 0.2, 2);
  std::vector<PoseConstraint> loops;
  std::erase_if(chain.constraints, [&](const PoseConstraint& c) {
    if (!test::is_loop(c)) return false;
    loops.push_back(c);
    return true;
  });
  GrowingOptimum growing(chain);
  const OptimizeResult result = growing.add(0, loops);
  EXPECT_TRUE(result.converged);
  chain.constraints.insert(chain.constraints.end(), loops.begin(), loops.end());
  const PoseGraph expected = optimum(chain);
  EXPECT_NEAR(result.objective, objective(expected), 1e-6 * result.objective);
  EXPECT_LT(difference(growing.graph(), expected), 1e-4);
}

TEST(GrowingOptimum, RenewsTheFactorWhereRunsAreMoreThanATenthOfTheGraph) {
  const PoseGraph complete = test::square_trajectory_graph(300, 20, 0.05, 4);
  const Parts parts(complete, 200);
  GrowingOptimum growing(parts.graph);
  const OptimizeResult result = growing.add(100, parts.further);
  EXPECT_TRUE(result.converged);
  EXPECT_GT(result.factorisations, 0);
  EXPECT_LT(difference(growing.graph(), optimum(complete)), 1e-5);
}

TEST(GrowingOptimum, RejectsRunsThatDoNotDetermineTheirPoses) {
  const PoseGraph graph = test::square_trajectory_graph(200, 20, 0.05);
  GrowingOptimum growing(graph);
  const std::vector<Pose2> before = growing.graph().poses;
  const OptimizeResult unconnected = growing.add(1, {});
  EXPECT_EQ(unconnected.reason, OptimizeReason::kUnconnected);
  EXPECT_EQ(unconnected.node, 200);
  PoseConstraint position{199, 200, {1.0, 0.0, 0.0}, Eigen::Matrix3d::Identity()};
  position.information(2, 2) = 0.0;
  const OptimizeResult undetermined = growing.add(1, {position});
  EXPECT_EQ(undetermined.reason, OptimizeReason::kUndetermined);
  EXPECT_EQ(undetermined.node, 200);
  EXPECT_EQ(growing.graph().poses, before);
  EXPECT_EQ(growing.graph().constraints.size(), graph.constraints.size());
}

}  // namespace
}  // namespace adit
