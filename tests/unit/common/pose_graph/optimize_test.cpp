// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/optimize.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

TEST(Optimize, RecoversTheTruthWithoutNoise) {
  PoseGraph graph = test::square_trajectory_graph(100, 6, 0.0);
  const std::vector<Pose2> truth = graph.poses;
  for (std::size_t i = 1; i < graph.poses.size(); ++i) graph.poses[i] = {};
  const OptimizeResult result = optimize(graph, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.objective, 1e-9);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(between(truth[i], graph.poses[i]).vector().norm(), 1e-6);  // sqrt(1e-9 / information)
  }
}

TEST(Optimize, HoldsTheFirstPose) {
  PoseGraph graph = test::square_trajectory_graph(60, 5, 0.1);
  graph.poses.front() = {3.0, 4.0, 1.0};
  ASSERT_TRUE(optimize(graph, {}).converged);
  EXPECT_EQ(graph.poses.front(), (Pose2{3.0, 4.0, 1.0}));
}

TEST(Optimize, ReachesTheSameObjectiveWithAndWithoutInitialization) {
  PoseGraph a = test::square_trajectory_graph(200, 8, 0.1);
  PoseGraph b = a;
  const OptimizeResult with = optimize(a, {});
  const OptimizeResult without = optimize(b, {.rotation_initialization = false});
  EXPECT_TRUE(with.converged && without.converged);
  EXPECT_NEAR(with.objective, without.objective, 1e-6 * with.objective);
  EXPECT_NEAR(with.objective, objective(a), 1e-9 * with.objective);
}

TEST(Optimize, IsDeterministic) {
  PoseGraph a = test::square_trajectory_graph(200, 8, 0.1);
  PoseGraph b = a;
  optimize(a, {});
  optimize(b, {});
  EXPECT_EQ(a.poses, b.poses);
}

TEST(Optimize, HandlesDirectionsWithoutInformation) {
  PoseGraph graph = test::square_trajectory_graph(100, 5, 0.05);
  for (PoseConstraint& c : graph.constraints) {
    if (c.to != c.from + 1) c.information = Eigen::Vector3d(0.0, 400.0, 0.0).asDiagonal();
  }
  EXPECT_TRUE(optimize(graph, {}).converged);
}

TEST(Optimize, ReportsANodeThatIsNotConnected) {
  PoseGraph graph = test::square_trajectory_graph(10, 5, 0.1);
  graph.constraints.erase(graph.constraints.begin() + 6);
  const OptimizeResult result = optimize(graph, {});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.reason, OptimizeReason::kUnconnected);
  EXPECT_EQ(result.node, 7);
  EXPECT_THAT(text(result.reason, result.node), testing::HasSubstr("pose 7"));
}

TEST(Optimize, ReportsANodeThatIsNotDetermined) {
  for (const bool rotation_initialization : {true, false}) {
    PoseGraph graph = test::square_trajectory_graph(10, 5, 0.1);
    graph.constraints.back().information = Eigen::Vector3d(0.0, 400.0, 4000.0).asDiagonal();
    const std::vector<Pose2> before = graph.poses;
    const OptimizeResult result =
        optimize(graph, {.rotation_initialization = rotation_initialization});
    EXPECT_EQ(result.reason, OptimizeReason::kUndetermined);
    EXPECT_EQ(result.node, 9);
    EXPECT_EQ(graph.poses, before);
  }
}

/// Wrong loops leave large residuals, with which Gauss-Newton alone contracts by percents per step.
TEST(Optimize, ConvergesInFewStepsWithLargeResiduals) {
  PoseGraph graph = test::square_trajectory_graph(3000, 100, 0.1);
  const auto wrong = test::random_wrong_loops(graph, 10, 1);
  graph.constraints.insert(graph.constraints.end(), wrong.begin(), wrong.end());
  const OptimizeResult result = optimize(graph, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.iterations, 100);
  const OptimizeResult again =
      optimize(graph, {.rotation_initialization = false, .tolerance = 1e-14});
  EXPECT_NEAR(again.objective, result.objective, 1e-8 * result.objective);
}

TEST(Optimize, HandlesGraphsOfZeroAndOnePoses) {
  PoseGraph graph;
  EXPECT_EQ(optimize(graph, {}).reason, OptimizeReason::kEmpty);
  graph.poses.emplace_back();
  EXPECT_TRUE(optimize(graph, {}).converged);
}

TEST(Optimize, ReportsItsPhasesToAnObserver) {
  PoseGraph graph = test::square_trajectory_graph(60, 5, 0.1);
  std::map<OptimizePhase, int> entered;
  const OptimizeResult result = optimize(graph, {}, [&](OptimizePhase p) { ++entered[p]; });
  EXPECT_EQ(entered[OptimizePhase::kAnalysis], 1);
  EXPECT_EQ(entered[OptimizePhase::kStart], 1);
  EXPECT_EQ(entered[OptimizePhase::kFactorisation],
            result.factorisations - 1);  // one is the initialisation
  EXPECT_EQ(entered[OptimizePhase::kEnd], 1);
}

TEST(ChainOdometry, FollowsTheMeasuredSteps) {
  PoseGraph graph;
  graph.poses.resize(3);
  graph.constraints = {{0, 1, {1.0, 0.0, 0.5}, Eigen::Matrix3d::Identity()},
                       {2, 1, Pose2{1.0, 0.0, 0.0}.inverse(), Eigen::Matrix3d::Identity()},
                       {0, 2, {9.0, 9.0, 9.0}, Eigen::Matrix3d::Identity()}};
  chain_odometry(graph);
  EXPECT_EQ(graph.poses[1], (Pose2{1.0, 0.0, 0.5}));
  EXPECT_NEAR(graph.poses[2].x, 1.0 + std::cos(0.5), 1e-12);
}

/// A public graph and the best known objective.
struct KnownOptimum {
  const char* name;
  double objective;
};

void PrintTo(const KnownOptimum& optimum, std::ostream* out) { *out << optimum.name; }

class OptimizeFromOdometry : public testing::TestWithParam<KnownOptimum> {};

TEST_P(OptimizeFromOdometry, ReachesTheBestKnownObjective) {
  const std::string name = std::string("posegraph/") + GetParam().name + ".g2o";
  ADIT_RECORDING_OR_SKIP(path, name);
  PoseGraph graph = read_g2o(path).graph;
  chain_odometry(graph);
  const OptimizeResult result = optimize(graph, {});
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.objective, GetParam().objective, 1e-7 * GetParam().objective);
  EXPECT_NEAR(result.objective, objective(graph), 1e-9 * GetParam().objective);
}

INSTANTIATE_TEST_SUITE_P(Public, OptimizeFromOdometry,
                         testing::Values(KnownOptimum{"intel", 45.004696},
                                         KnownOptimum{"CSAIL", 40.555128},
                                         KnownOptimum{"MIT", 41.163269},
                                         KnownOptimum{"manhattan", 3549.036766},
                                         KnownOptimum{"M3500a", 912.115012}));

}  // namespace
}  // namespace adit
