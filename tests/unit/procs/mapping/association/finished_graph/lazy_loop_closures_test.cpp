// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/pose_graph/pose_graph.hpp"
#include "tests/support/graphs/generated_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

using testing::Each;

class LazyLoopClosures : public testing::Test {
 protected:
  /// Appends loops; the number of accepted ones among them and among the others.
  struct Accepted {
    long right = 0;
    long wrong = 0;
  };
  [[nodiscard]] Accepted accepted_with(const std::vector<PoseConstraint>& wrong,
                                       const LazyAssociationParams& params = {}) const {
    PoseGraph graph = graph_;
    graph.constraints.insert(graph.constraints.end(), wrong.begin(), wrong.end());
    chain_odometry(graph);
    const auto accepted = associate_loops_lazily(graph, params).accepted;
    const auto first_wrong = accepted.begin() + std::ssize(graph_.constraints);
    return {std::count(accepted.begin(), first_wrong, true),
            std::count(first_wrong, accepted.end(), true)};
  }

  PoseGraph graph_ = test::square_trajectory_graph(400, 20, 0.1);
};

TEST_F(LazyLoopClosures, AcceptAllCorrectLoops) {
  const LazyLoopClosuresResult result = associate_loops_lazily(graph_, {});
  EXPECT_THAT(result.accepted, Each(true));
  EXPECT_EQ(result.constraint_of_loop_closure.size(), 320U);  // a lap is 80
  EXPECT_EQ(result.history.size(), 320U);
}

TEST_F(LazyLoopClosures, RejectWrongLoops) {
  const auto right = std::ssize(graph_.constraints);
  for (const bool best_first : {true, false}) {
    const LazyAssociationParams params{.best_first = best_first};
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      const Accepted random = accepted_with(test::random_wrong_loops(graph_, 30, seed), params);
      EXPECT_EQ(random.wrong, 0);
      EXPECT_EQ(random.right, right);
      const Accepted groups = accepted_with(test::consistent_wrong_loops(graph_, 60, seed), params);
      EXPECT_EQ(groups.wrong, 0);
      EXPECT_EQ(groups.right, right);
    }
  }
}

/// The same loops, each as the pose of the earlier node in the later one.
TEST_F(LazyLoopClosures, MayBeGivenInEitherDirection) {
  const auto wrong = test::random_wrong_loops(graph_, 30, 1);
  const Accepted forward = accepted_with(wrong);
  for (PoseConstraint& c : graph_.constraints) {
    const Eigen::Matrix3d Ad = adjoint(c.T_from_to);
    const Eigen::Matrix3d inverse = Ad.inverse();
    c = {c.to, c.from, c.T_from_to.inverse(), inverse.transpose() * c.information * inverse};
  }
  const Accepted back = accepted_with(wrong);
  EXPECT_EQ(back.right, forward.right);
  EXPECT_EQ(back.wrong, forward.wrong);
}

TEST_F(LazyLoopClosures, AreOrderedByTheirLaterNodeInThePapersOrder) {
  std::reverse(graph_.constraints.begin(), graph_.constraints.end());
  const LazyLoopClosuresResult result =
      associate_loops_lazily(graph_, LazyAssociationParams{.best_first = false});
  int last = 0;
  for (const int k : result.constraint_of_loop_closure) {
    const int later = graph_.constraints[static_cast<std::size_t>(k)].to;
    EXPECT_GE(later, last);
    last = later;
  }
  EXPECT_THAT(result.accepted, Each(true));
}

/// Information may be stated at any scale: smaller, wrong loops fit by chance.
TEST_F(LazyLoopClosures, EstimateTheNoiseOfTheirMeasurements) {
  const auto right = std::ssize(graph_.constraints);
  const auto wrong = test::random_wrong_loops(graph_, 300, 1);
  for (PoseConstraint& c : graph_.constraints) c.information *= 0.02;
  auto scaled = wrong;
  for (PoseConstraint& c : scaled) c.information *= 0.02;
  const Accepted accepted = accepted_with(scaled);
  EXPECT_EQ(accepted.wrong, 0);
  EXPECT_EQ(accepted.right, right);
}

/// With errors 1.6 times as large as stated the gates reject some right loops, until the chi-square
/// of the map shows it.
TEST(LazyLoopClosuresOfGeneratedGraphs, AreRightWhereTheNoiseIsLargerThanStated) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    for (const auto world : {test::GraphWorld::kGrid, test::GraphWorld::kMine}) {
      test::LabelledGraph labelled =
          test::generated_graph({world, 400, 400, 0.02, test::WrongLoops::kRandom, 0.2, seed});
      for (PoseConstraint& c : labelled.graph.constraints) c.information *= 1.6 * 1.6;
      const LazyLoopClosuresResult result = associate_loops_lazily(labelled.graph, {});
      EXPECT_EQ(test::count_accepted(labelled, result.accepted, test::LoopLabel::kRight),
                std::ranges::count(labelled.labels, test::LoopLabel::kRight));
      EXPECT_EQ(test::count_accepted(labelled, result.accepted, test::LoopLabel::kWrong), 0);
    }
  }
}

/// A group of 20 wrong loops fits a map of large drift; all of them contradict the map without it.
TEST(LazyLoopClosuresOfGeneratedGraphs, AreDoubtfulWithAWrongGroup) {
  const test::LabelledGraph labelled = test::generated_graph(test::random_scenario(54));
  const LazyLoopClosuresResult result = associate_loops_lazily(labelled.graph, {});
  ASSERT_GT(test::count_accepted(labelled, result.accepted, test::LoopLabel::kWrong), 0);
  EXPECT_THAT(result.doubts, testing::Not(testing::IsEmpty()));
}

/// Worlds, drifts and kinds of wrong loops beyond those on which the method was developed.
TEST(LazyLoopClosuresOfGeneratedGraphs, AreRightForTheMostPart) {
  long right = 0;
  long accepted_right = 0;
  long accepted_wrong = 0;
  for (std::uint32_t seed = 1001; seed <= 1012; ++seed) {
    test::GraphScenario scenario = test::random_scenario(seed);
    scenario.poses = std::min(scenario.poses, 600);
    const test::LabelledGraph labelled = test::generated_graph(scenario);
    const auto accepted = associate_loops_lazily(labelled.graph, {}).accepted;
    right += std::ranges::count(labelled.labels, test::LoopLabel::kRight);
    accepted_right += test::count_accepted(labelled, accepted, test::LoopLabel::kRight);
    accepted_wrong += test::count_accepted(labelled, accepted, test::LoopLabel::kWrong);
  }
  EXPECT_GT(accepted_right, 0.98 * static_cast<double>(right));
  EXPECT_LT(accepted_wrong, 0.02 * static_cast<double>(accepted_right));
}

TEST_F(LazyLoopClosures, ReportProgress) {
  double done = 0.0;
  associate_loops_lazily(graph_, {}, [&](double share) {
    EXPECT_GT(share, done);
    done = share;
  });
  EXPECT_EQ(done, 1.0);
}

/// As in files in which some constraints of the odometry are missing.
TEST_F(LazyLoopClosures, AreDecidedAcrossGapsOfTheOdometry) {
  const auto wrong = test::random_wrong_loops(graph_, 30, 1);
  std::erase_if(graph_.constraints, [](const PoseConstraint& c) {
    return c.to == c.from + 1 && (c.from == 41 || c.from == 42 || c.from == 230);
  });
  const auto right = std::ssize(graph_.constraints);
  for (const bool best_first : {true, false}) {
    const Accepted accepted = accepted_with(wrong, {.best_first = best_first});
    EXPECT_EQ(accepted.wrong, 0);
    EXPECT_EQ(accepted.right, right);
  }
  EXPECT_EQ(associate_loops_lazily(graph_, {}).bridges.size(), 3U);
}

TEST_F(LazyLoopClosures, RequireAConnectedGraph) {
  std::erase_if(graph_.constraints, [](const auto& c) { return c.from < 42 && c.to >= 42; });
  EXPECT_THROW(associate_loops_lazily(graph_, {}), std::invalid_argument);
}

/// Each line twice, as in concatenated files.
TEST_F(LazyLoopClosures, MayBeDuplicates) {
  const std::vector<PoseConstraint> once = graph_.constraints;
  graph_.constraints.insert(graph_.constraints.end(), once.begin(), once.end());
  const LazyLoopClosuresResult result = associate_loops_lazily(graph_, {});
  EXPECT_THAT(result.accepted, Each(true));
  EXPECT_EQ(result.constraint_of_loop_closure.size(), 2 * once.size() - 399);  // not the odometry
}

/// Loops that measure no rotation, and a step of the odometry that measures no position.
TEST_F(LazyLoopClosures, MayHaveSingularInformation) {
  for (PoseConstraint& c : graph_.constraints) {
    if (test::is_loop(c)) c.information = Eigen::Vector3d(100.0, 100.0, 0.0).asDiagonal();
  }
  graph_.constraints[50].information = Eigen::Vector3d(0.0, 0.0, 1e4).asDiagonal();
  const LazyLoopClosuresResult result = associate_loops_lazily(graph_, {});
  EXPECT_THAT(result.accepted, Each(true));
  PoseGraph optimized = graph_;
  EXPECT_TRUE(optimize_accepted(optimized, result.accepted).converged);
}

TEST(LazyLoopClosuresOfAFewPoses, AreEmptyForAGraphWithoutLoops) {
  EXPECT_THAT(associate_loops_lazily({}, {}).accepted, testing::IsEmpty());
  PoseGraph graph = test::square_trajectory_graph(10, 5, 0.1);
  EXPECT_EQ(associate_loops_lazily(graph, {}).accepted, std::vector<bool>(9, true));
}

/// Two consecutive poses with odometry 0 and a loop `apart`: the first constraint between
/// neighbours is the odometry, the second may be wrong.
PoseGraph two_measurements(double apart) {
  PoseGraph graph;
  graph.poses.resize(2);
  graph.constraints = {{0, 1, {}, Eigen::Matrix3d::Identity()},
                       {0, 1, {apart, 0.0, 0.0}, Eigen::Matrix3d::Identity()}};
  return graph;
}

TEST(LazyLoopClosuresOfAFewPoses, MayContradictTheOdometryOnlyWithinTheGate) {
  EXPECT_EQ(associate_loops_lazily(two_measurements(6.0), {}).accepted,
            (std::vector<bool>{true, true}));
  EXPECT_EQ(associate_loops_lazily(two_measurements(7.0), {}).accepted,
            (std::vector<bool>{true, false}));
}

/// The local minimum, from the middle, of x² + (d − x)² / (1 + (d − x)² / k), the kernel of Geman
/// and McClure: where its derivative is zero.
double optimum(double d) {
  constexpr double kKernel2 = 7.8;
  double low = 0.0;
  double high = 0.5 * d;
  while (high - low > 1e-12) {
    const double x = 0.5 * (low + high);
    const double root = 1.0 + (d - x) * (d - x) / kKernel2;
    const double slope = x - (d - x) / (root * root);
    (slope < 0.0 ? low : high) = x;
  }
  return low;
}

/// The doubt if the first `accepted` of ten loops are accepted.
std::optional<std::string> doubt_with(int accepted, double objective) {
  LazyLoopClosuresResult result;
  for (int k = 0; k < 10; ++k) {
    result.accepted.push_back(k < accepted);
    result.constraint_of_loop_closure.push_back(k);
  }
  return doubt_of_misfit(result, objective);
}

TEST(DoubtOfMisfit, IsStatedFromFourTimesTheExpectationOn) {
  EXPECT_FALSE(doubt_with(8, 95.0));  // expected: 3 degrees of freedom for each of the 8, 24
  EXPECT_THAT(doubt_with(8, 97.0), testing::Optional(testing::HasSubstr("4.0 times")));
  EXPECT_FALSE(doubt_with(10, 97.0));
  EXPECT_FALSE(doubt_with(7, 1e6));  // too few to tell
}

/// The doubt if all loops are accepted, with a stated noise `factor` times as large as the errors.
std::optional<std::string> doubt_of_all(test::GraphScenario scenario, double factor = 1.0) {
  test::LabelledGraph labelled = test::generated_graph(scenario);
  LazyLoopClosuresResult result;
  for (std::size_t k = 0; k < labelled.labels.size(); ++k) {
    labelled.graph.constraints[k].information /= factor * factor;
    result.accepted.push_back(true);
    if (labelled.labels[k] == test::LoopLabel::kNone) continue;
    result.constraint_of_loop_closure.push_back(static_cast<int>(k));
  }
  const double objective = optimize_accepted(labelled.graph, result.accepted).objective;
  return doubt_of_misfit(result, objective);
}

class DoubtOfGeneratedGraphs : public testing::TestWithParam<test::GraphWorld> {
 protected:
  [[nodiscard]] static test::GraphScenario scenario(std::uint32_t seed, double wrong_share = 0.0) {
    return {GetParam(), 300, 300, 0.05, test::WrongLoops::kGroups, wrong_share, seed};
  }
};

INSTANTIATE_TEST_SUITE_P(All, DoubtOfGeneratedGraphs,
                         testing::Values(test::GraphWorld::kGrid, test::GraphWorld::kRings,
                                         test::GraphWorld::kMine),
                         [](const auto& world) { return test::text(world.param); });

/// The mean of a chi-square of 300 loops differs from 1 by less than a tenth.
TEST_P(DoubtOfGeneratedGraphs, IsNotStatedIfTheNoiseIsAsStated) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    EXPECT_FALSE(doubt_of_all(scenario(seed)));
    const test::LabelledGraph labelled = test::generated_graph(scenario(seed));
    EXPECT_THAT(associate_loops_lazily(labelled.graph, {}).doubts, testing::IsEmpty());
  }
}

TEST_P(DoubtOfGeneratedGraphs, IsStatedIfTheNoiseIsThreeTimesAsLarge) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    EXPECT_TRUE(doubt_of_all(scenario(seed), 1.0 / 3.0));  // a chi-square of 9 times
  }
}

TEST_P(DoubtOfGeneratedGraphs, IsStatedIfWrongGroupsAreAccepted) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) EXPECT_TRUE(doubt_of_all(scenario(seed, 0.3)));
}

TEST(OptimizeAccepted, DownWeightsALoopByItsResidual) {
  for (const double apart : {0.5, 2.0, 5.0}) {
    PoseGraph graph = two_measurements(apart);
    const OptimizeResult result = optimize_accepted(graph, {true, true});
    const double x = graph.poses[1].x;
    EXPECT_NEAR(x, optimum(apart), 1e-3 * apart);
    EXPECT_NEAR(result.objective, x * x + (apart - x) * (apart - x), 1e-9);
    EXPECT_TRUE(result.converged);
  }
}

TEST(OptimizeAccepted, IgnoresRejectedLoops) {
  PoseGraph graph = two_measurements(5.0);
  const OptimizeResult result = optimize_accepted(graph, {true, false});
  EXPECT_NEAR(graph.poses[1].x, 0.0, 1e-9);
  EXPECT_NEAR(result.objective, 0.0, 1e-12);
}

TEST(OptimizeAccepted, LeavesUndeterminedPosesUnchanged) {
  PoseGraph graph = two_measurements(5.0);
  graph.poses[1].x = 3.0;
  const OptimizeResult result = optimize_accepted(graph, {false, false});
  EXPECT_EQ(result.reason, OptimizeReason::kUnconnected);
  EXPECT_EQ(result.node, 1);
  EXPECT_EQ(graph.poses[1].x, 3.0);
}

TEST(OptimizeAccepted, ReportsTheEndToTheObserver) {
  PoseGraph graph = two_measurements(5.0);
  std::vector<OptimizePhase> phases;
  optimize_accepted(graph, {true, true}, [&](OptimizePhase phase) { phases.push_back(phase); });
  EXPECT_EQ(phases.back(), OptimizePhase::kEnd);
}

}  // namespace
}  // namespace adit
