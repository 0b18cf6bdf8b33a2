// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/point_to_line.hpp"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

const Pose2 kReferencePose{-2.0, 0.0, 0.2};

SurfelMap reference_of(const test::WallWorld& world) {
  SurfelMap map{SurfelMapParams{}};
  map.insert(test::scan_points(world, kReferencePose), kReferencePose, 0.0);
  return map;
}

class PointToLineRecovers : public testing::TestWithParam<Pose2> {};

TEST_P(PointToLineRecovers, AKnownMotionWithoutAGuess) {
  const test::WallWorld room = test::crooked_room();
  const Pose2 truth = kReferencePose * GetParam();
  const auto result = match_point_to_line(test::scan_points(room, truth), reference_of(room),
                                          kReferencePose, PosePrior{}, PointToLineParams{});
  const Pose2 error = between(truth, result.T_odom_body);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(error.translation().norm(), 0.002);  // points are sampled: 1/25 of a surfel's spacing
  EXPECT_LT(std::abs(error.theta), 0.001);
  EXPECT_GT(result.inlier_share, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Motions, PointToLineRecovers,
                         testing::Values(Pose2{}, Pose2{0.2, 0.0, 0.0}, Pose2{0.0, 0.15, 0.0},
                                         Pose2{-0.2, 0.1, 0.0}, Pose2{0.0, 0.0, 0.1},
                                         Pose2{0.1, 0.05, -0.1}));

TEST(PointToLine, FollowsAStrongPriorAndIgnoresAWeakPrior) {
  const test::WallWorld room = test::crooked_room();
  const auto points = test::scan_points(room, kReferencePose);
  const SurfelMap reference = reference_of(room);
  PosePrior prior;
  prior.T_odom_body = kReferencePose * Pose2{0.05, 0.0, 0.0};
  prior.information = 1e12 * Eigen::Matrix3d::Identity();
  const auto pulled = match_point_to_line(points, reference, kReferencePose, prior, {});
  EXPECT_NEAR(between(prior.T_odom_body, pulled.T_odom_body).vector().norm(), 0.0, 1e-4);
  prior.information = Eigen::Matrix3d::Identity();
  const auto free = match_point_to_line(points, reference, kReferencePose, prior, {});
  EXPECT_NEAR(between(kReferencePose, free.T_odom_body).vector().norm(), 0.0, 1e-3);
}

TEST(PointToLine, StopsOnTheTrailOfAConvergedMatch) {
  const test::WallWorld room = test::crooked_room();
  const Pose2 truth = kReferencePose * Pose2{0.1, 0.05, -0.1};
  const auto points = test::scan_points(room, truth);
  const SurfelMap reference = reference_of(room);
  MatchTrail trail;
  const auto first = match_point_to_line(points, reference, kReferencePose, {}, {}, &trail);
  ASSERT_TRUE(first.converged);
  EXPECT_FALSE(first.duplicate);
  ASSERT_FALSE(trail.empty());
  const Pose2 elsewhere = truth * Pose2{0.1, -0.1, 0.05};
  const auto alone = match_point_to_line(points, reference, elsewhere, {}, {});
  const auto second = match_point_to_line(points, reference, elsewhere, {}, {}, &trail);
  EXPECT_TRUE(second.duplicate);
  EXPECT_LT(second.iterations, alone.iterations);
}

TEST(PointToLine, AddsNoTrailIfItDoesNotConverge) {
  const test::WallWorld room = test::crooked_room();
  const auto points = test::scan_points(room, kReferencePose * Pose2{0.1, 0.05, -0.1});
  PointToLineParams hasty;
  hasty.iterations_max = 2;
  MatchTrail trail;
  const auto result =
      match_point_to_line(points, reference_of(room), kReferencePose, {}, hasty, &trail);
  EXPECT_FALSE(result.converged);
  EXPECT_TRUE(trail.empty());
}

TEST(PointToLine, ReturnsNoStatisticsWithoutPointsOrReference) {
  const test::WallWorld room = test::crooked_room();
  const SurfelMap nothing{SurfelMapParams{}};
  const auto no_reference =
      match_point_to_line(test::scan_points(room, {}), nothing, kReferencePose, PosePrior{}, {});
  const auto no_points = match_point_to_line({}, reference_of(room), kReferencePose, {}, {});
  for (const auto& result : {no_reference, no_points}) {
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.inlier_share, 0.0);
    EXPECT_TRUE(result.information.isZero());
    EXPECT_EQ(result.T_odom_body, kReferencePose);
  }
}

TEST(PointToLine, HasFewInliersInADifferentPlace) {
  const auto result = match_point_to_line(test::scan_points(test::straight_tunnel(60.0, 2.0), {}),
                                          reference_of(test::crooked_room()), kReferencePose,
                                          PosePrior{}, PointToLineParams{});
  EXPECT_LT(result.inlier_share, 0.6);
}

TEST(PointToLine, InformationIsConsistentWithTheSpreadOfEstimates) {
  // The information matrix is the curvature of half the squared, standardised residuals, so the
  // spread of estimates over noise has its inverse as covariance.
  const test::WallWorld room = test::crooked_room();
  Eigen::Matrix3d claimed = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  constexpr int kTrials = 300;
  const SurfelMap reference = reference_of(room);
  for (int i = 0; i < kTrials; ++i) {
    const LaserScan scan = test::LevelLaser(room, i + 1).measure(kReferencePose, 1'000'000);
    const auto result =
        match_point_to_line(test::scan_points(scan), reference, kReferencePose, PosePrior{}, {});
    const Eigen::Vector3d error = between(kReferencePose, result.T_odom_body).vector();
    spread += error * error.transpose() / kTrials;
    claimed += result.information.inverse() / kTrials;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(claimed(k, k), 0.5 * spread(k, k)) << k;  // over 300 trials a variance is known to
    EXPECT_LT(claimed(k, k), 2.5 * spread(k, k)) << k;  // 8 %; the rest is the model's error
  }
}

}  // namespace
}  // namespace adit
