// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/loop_consensus.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"
#include "tests/support/graphs/generated_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

using test::GraphScenario;
using test::GraphWorld;
using test::LabelledGraph;
using test::LoopLabel;
using test::WrongLoops;
using testing::Each;
using testing::IsEmpty;
using testing::Not;

double fit_gate() { return LazyAssociationParams{}.gate; }

Eigen::Matrix3d information_of(double m, double rad) {
  return Eigen::Vector3d(1.0 / (m * m), 1.0 / (m * m), 1.0 / (rad * rad)).asDiagonal();
}

/// 500 poses and 500 right loops; the odometry has an error of 4.5 rad in all.
LabelledGraph graph_without_heading(GraphWorld world, std::uint32_t seed, WrongLoops wrong = {},
                                    double wrong_share = 0.0) {
  LabelledGraph labelled = test::generated_graph({world, 500, 500, 0.05, wrong, wrong_share, seed});
  test::lose_heading(labelled, seed);
  return labelled;
}

std::optional<LoopConsensus> consensus_of(const PoseGraph& graph) {
  return find_consensus(graph, GraphOdometry(graph, fit_gate()), fit_gate());
}

PoseGraph straight_odometry(int steps, double rad) {
  PoseGraph graph;
  graph.poses.resize(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i < steps; ++i) {
    graph.constraints.push_back({i, i + 1, {1.0, 0.0, 0.0}, information_of(0.05, rad)});
  }
  chain_odometry(graph);
  return graph;
}

TEST(LosesHeading, IfItsDeviationExceedsHalfATurn) {
  const auto loses = [](const PoseGraph& graph) {
    return loses_heading(GraphOdometry(graph, fit_gate()));
  };
  EXPECT_FALSE(loses(straight_odometry(100, 0.31)));  // 3.1 rad in all
  EXPECT_TRUE(loses(straight_odometry(100, 0.32)));
  EXPECT_FALSE(loses(straight_odometry(0, 0.32)));
  EXPECT_FALSE(loses({}));
}

class LoopConsensusOfWorlds : public testing::TestWithParam<GraphWorld> {};

INSTANTIATE_TEST_SUITE_P(All, LoopConsensusOfWorlds,
                         testing::Values(GraphWorld::kGrid, GraphWorld::kRings, GraphWorld::kMine),
                         [](const auto& world) { return test::text(world.param); });

TEST_P(LoopConsensusOfWorlds, AcceptsAllRightLoops) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const LabelledGraph labelled = graph_without_heading(GetParam(), seed);
    ASSERT_TRUE(loses_heading(GraphOdometry(labelled.graph, fit_gate())));
    const auto consensus = consensus_of(labelled.graph);
    ASSERT_TRUE(consensus);
    EXPECT_THAT(consensus->accepted, Each(true));
    EXPECT_FALSE(consensus->is_contradictory);
    // The optimum fits the measurements at least as well as the truth.
    const auto& constraints = labelled.graph.constraints;
    EXPECT_LT(objective({consensus->T_map_node, constraints}),
              objective({labelled.truth, constraints}));
  }
}

TEST_P(LoopConsensusOfWorlds, RejectsRandomWrongLoops) {
  long right = 0;
  long wrong = 0;
  long accepted_right = 0;
  long accepted_wrong = 0;
  for (const double share : {0.04, 0.3}) {
    for (const std::uint32_t seed : {1U, 2U}) {
      const LabelledGraph labelled =
          graph_without_heading(GetParam(), seed, WrongLoops::kRandom, share);
      const auto consensus = consensus_of(labelled.graph);
      if (!consensus) continue;
      right += std::ranges::count(labelled.labels, LoopLabel::kRight);
      wrong += std::ranges::count(labelled.labels, LoopLabel::kWrong);
      accepted_right += test::count_accepted(labelled, consensus->accepted, LoopLabel::kRight);
      accepted_wrong += test::count_accepted(labelled, consensus->accepted, LoopLabel::kWrong);
    }
  }
  EXPECT_GE(right, 1500);  // a consensus of three graphs of the four at least
  EXPECT_GE(accepted_right, 0.98 * static_cast<double>(right));
  EXPECT_LE(accepted_wrong, 0.01 * static_cast<double>(wrong));  // the admitted chance of a fit
}

/// As where two groups of loops contradict each other: the selection does not search among them.
TEST_P(LoopConsensusOfWorlds, DoesNotExistIfManyGroupsContradictEachOther) {
  for (const std::uint32_t seed : {1U, 2U}) {
    for (const WrongLoops wrong : {WrongLoops::kGroups, WrongLoops::kParallel}) {
      const LabelledGraph labelled = graph_without_heading(GetParam(), seed, wrong, 0.3);
      EXPECT_FALSE(consensus_of(labelled.graph));
    }
  }
}

TEST_P(LoopConsensusOfWorlds, IsDeterministic) {
  const LabelledGraph labelled = graph_without_heading(GetParam(), 1, WrongLoops::kRandom, 0.04);
  const auto first = consensus_of(labelled.graph);
  const auto second = consensus_of(labelled.graph);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->accepted, second->accepted);
  EXPECT_EQ(first->is_certified, second->is_certified);
  for (std::size_t i = 0; i < first->T_map_node.size(); ++i) {
    EXPECT_EQ(first->T_map_node[i].vector(), second->T_map_node[i].vector());
  }
}

/// The same loops, each as the pose of the earlier node in the later one.
TEST_P(LoopConsensusOfWorlds, IsTheSameInEitherDirectionOfTheLoops) {
  LabelledGraph labelled = graph_without_heading(GetParam(), 1, WrongLoops::kRandom, 0.04);
  const auto forward = consensus_of(labelled.graph);
  for (PoseConstraint& c : labelled.graph.constraints) {
    const Eigen::Matrix3d inverse = adjoint(c.T_from_to).inverse();
    c = {c.to, c.from, c.T_from_to.inverse(), inverse.transpose() * c.information * inverse};
  }
  const auto back = consensus_of(labelled.graph);
  ASSERT_TRUE(forward && back);
  EXPECT_EQ(back->accepted, forward->accepted);
}

/// One group of 20 wrong loops among 500 right ones. It fits all others by chance where these leave
/// the map bent as it needs: in 2 of 24 graphs; 5 of them without the test of groups.
TEST(LoopConsensus, IsDoubtfulWithAWrongGroup) {
  int wrong_without_doubt = 0;
  for (const GraphWorld world : {GraphWorld::kGrid, GraphWorld::kRings, GraphWorld::kMine}) {
    for (const WrongLoops wrong : {WrongLoops::kGroups, WrongLoops::kParallel}) {
      for (const std::uint32_t seed : {9U, 10U, 11U, 12U}) {
        const LabelledGraph labelled = graph_without_heading(world, seed, wrong, 0.04);
        const auto consensus = consensus_of(labelled.graph);
        if (!consensus || !consensus->is_certified || consensus->is_contradictory) continue;
        const int accepted = test::count_accepted(labelled, consensus->accepted, LoopLabel::kWrong);
        wrong_without_doubt += accepted > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_LE(wrong_without_doubt, 2);
}

TEST(LoopConsensus, IsTheOdometryWithoutLoops) {
  const PoseGraph graph = straight_odometry(100, 0.4);
  const auto consensus = consensus_of(graph);
  ASSERT_TRUE(consensus);
  EXPECT_THAT(consensus->accepted, Each(true));
  EXPECT_TRUE(consensus->is_certified);
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    EXPECT_LT(between(graph.poses[i], consensus->T_map_node[i]).vector().norm(), 1e-6);
  }
}

TEST(LoopConsensus, OfAnEmptyGraphIsEmpty) {
  const auto consensus = consensus_of({});
  ASSERT_TRUE(consensus);
  EXPECT_THAT(consensus->accepted, IsEmpty());
  EXPECT_THAT(consensus->T_map_node, IsEmpty());
}

/// Loops too far apart to support each other give no first map; to reject them all would be wrong.
TEST(LoopConsensus, DoesNotExistIfNoLoopHasSupport) {
  LabelledGraph labelled = graph_without_heading(GraphWorld::kRings, 1);
  int last = 0;
  std::erase_if(labelled.graph.constraints, [&](const PoseConstraint& c) {
    if (c.to == c.from + 1) return false;
    const bool near = c.to - last < 25;
    if (!near) last = c.to;
    return near;
  });
  ASSERT_GE(labelled.graph.constraints.size(), 500U);
  EXPECT_FALSE(consensus_of(labelled.graph));
  EXPECT_THAT(associate_loops_lazily(labelled.graph, {}).doubts, Not(IsEmpty()));
}

/// A loop that measures no rotation bridges a gap; the only measurement of the rotation there has
/// no support.
TEST(LoopConsensus, MayDependOnABridgeWithSingularInformation) {
  LabelledGraph labelled = graph_without_heading(GraphWorld::kRings, 1);
  const auto is_across = [](const PoseConstraint& c) { return c.from <= 450 && c.to > 450; };
  bool has_bridge = false;
  std::erase_if(labelled.graph.constraints, [&](const PoseConstraint& c) {
    return is_across(c) && test::is_loop(c) && std::exchange(has_bridge, true);
  });
  for (PoseConstraint& c : labelled.graph.constraints) {
    if (!is_across(c)) continue;
    c.information = test::is_loop(c) ? Eigen::Vector3d(400.0, 400.0, 0.0).asDiagonal()
                                     : Eigen::Vector3d(0.0, 0.0, 1e4).asDiagonal();
  }
  ASSERT_EQ(GraphOdometry(labelled.graph, fit_gate()).bridges.size(), 1U);
  const auto consensus = consensus_of(labelled.graph);
  ASSERT_TRUE(consensus);
  EXPECT_LE(std::ranges::count(consensus->accepted, false), 1);  // the measurement of the rotation
}

}  // namespace
}  // namespace adit
