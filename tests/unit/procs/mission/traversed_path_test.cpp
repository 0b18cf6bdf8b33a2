// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/traversed_path.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(TraversedPath, HasTheLengthOfTheArcThatWasDriven) {
  TraversedPath traversed;
  const double radius_m = 5.0;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = 2.0 * i / 1000.0;
    traversed.add(i, {radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)), angle});
  }
  EXPECT_NEAR(traversed.distance_travelled_m(), 10.0, 0.2);  // spacing of stored poses
}

TEST(TraversedPath, IgnoresPoseNoiseOfAStandingRobot) {
  TraversedPath traversed;
  for (int i = 0; i < 1000; ++i)
    traversed.add(i, {0.05 * std::sin(i), 0.05 * std::cos(3.0 * i), 0.0});
  EXPECT_EQ(traversed.distance_travelled_m(), 0.0);
}

TEST(TraversedPath, LeadsBackOverTheStoredPoses) {
  TraversedPath traversed;
  for (int i = 0; i <= 40; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});       // to 10, 0
  for (int i = 1; i <= 8; ++i) traversed.add(40 + i, {10.0, 0.25 * i, 1.5});  // to 10, 2
  const auto path = traversed.back(4.0);
  ASSERT_GT(path.size(), 2U);
  EXPECT_EQ(path.front(), Pose2(10.0, 2.0, 1.5));
  EXPECT_NEAR(path.back().x, 8.0, 0.26);  // spacing of poses
  EXPECT_NEAR(path.back().y, 0.0, 1e-9);
  EXPECT_EQ(path.back().theta, 0.0);
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_m += (path[i].translation() - path[i - 1].translation()).norm();
  }
  EXPECT_GE(length_m, 4.0);
  EXPECT_LE(length_m, 4.25);
}

/// A loop closure moves odom in map by a metre: what was driven long ago stays in map.
TEST(TraversedPath, MovesEarlyPosesWithTheMapAndNewOnesWithOdom) {
  TraversedPath traversed;
  for (int i = 0; i <= 120; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});  // to 30, 0
  traversed.correct({0.0, 1.0, 0.0});
  const auto path = traversed.back(40.0);
  EXPECT_NEAR(path.back().x, 0.0, 0.26);
  EXPECT_NEAR(path.back().y, 1.0, 1e-9);
  for (const Pose2& T_odom : path) {
    if (T_odom.x < 20.5) continue;
    EXPECT_EQ(T_odom.y, 0.0) << T_odom.x;  // the newest 10 m
  }
}

TEST(TraversedPath, RemembersTheLastMetresOfAReturnToItsStart) {
  TraversedPath traversed;
  for (int i = 0; i <= 40; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});
  for (int i = 39; i >= 0; --i) traversed.add(80 - i, {0.25 * i, 0.0, 0.0});
  EXPECT_LT(traversed.back_length_m(5.0), 0.3);  // it is at its start
  const auto path = traversed.recent(5.0);
  EXPECT_NEAR(path.front().x, 0.0, 1e-9);
  EXPECT_NEAR(path.back().x, 5.0, 0.26);  // spacing of poses
}

/// Into a side tunnel and out restored.
TEST(TraversedPath, RemovesALoopAfterReturning) {
  TraversedPath traversed;
  int i = 0;
  for (; i <= 40; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});               // to 10, 0
  for (; i <= 60; ++i) traversed.add(i, {0.25 * (80 - i) + 0.1, 0.0, 0.0});  // in reverse to 5, 0
  EXPECT_NEAR(traversed.distance_travelled_m(), 15.0, 0.3);  // spacing of poses, in both directions
  const auto path = traversed.back(100.0);
  EXPECT_NEAR(path.back().x, 0.0, 1e-9);
  for (std::size_t k = 1; k < path.size(); ++k) EXPECT_LE(path[k].x, path[k - 1].x);
}

/// A pose beside the path or turned against it is another pose.
TEST(TraversedPath, DoesNotRemoveALoopToAnotherPose) {
  for (const Pose2& beside : {Pose2{5.0, 0.5, 0.0}, Pose2{5.0, 0.0, 0.5}}) {
    TraversedPath traversed;
    for (int i = 0; i <= 40; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});
    traversed.add(41, beside);
    EXPECT_EQ(traversed.back(100.0).size(), 43U);  // all stored poses and the newest
  }
}

/// Once around a spiral ramp, to the place below its beginning.
TraversedPath once_down_a_spiral(double climb_m) {
  constexpr double kRadiusM = 10.0;
  constexpr int kSteps = 320;
  TraversedPath traversed;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSteps;
    traversed.add(i, {kRadiusM * std::sin(angle), kRadiusM * (1.0 - std::cos(angle)), angle},
                  climb_m * i / kSteps);
  }
  return traversed;
}

TEST(TraversedPath, KeepsALoopToAnotherLevel) {
  EXPECT_LT(once_down_a_spiral(-1.0).back_length_m(100.0), 1.0);  // the same tunnel: removed
  EXPECT_NEAR(once_down_a_spiral(-5.0).back_length_m(100.0), 62.8, 0.1);
}

TEST(TraversedPath, ReturnsPosesNearbyOfTheSameLevelOnly) {
  // 3 m of this level, 0.39 m apart, not the 3 m at the beginning above it.
  EXPECT_EQ(once_down_a_spiral(-5.0).poses_back_within(3.0).size(), 9U);
}

/// The heights in odom are 0.5 m wrong, which a loop closure corrects.
TEST(TraversedPath, MovesEarlyPosesInHeightToo) {
  TraversedPath traversed = once_down_a_spiral(-2.7);
  EXPECT_NEAR(traversed.back_length_m(100.0), 62.8, 0.1);
  traversed.correct({}, -0.5);
  traversed.add(1000, {0.3, 0.0, 0.0}, -2.7);
  EXPECT_LT(traversed.back_length_m(100.0), 1.0);
}

TEST(TraversedPath, HasNoLengthForATurnOnTheSpot) {
  TraversedPath traversed;
  for (int i = 0; i < 20; ++i) traversed.add(i, {0.0, 0.0, 0.12 * i});
  EXPECT_GT(traversed.back(3.0).size(), 10U);
  EXPECT_EQ(traversed.back_length_m(3.0), 0.0);
  for (int i = 0; i < 20; ++i) traversed.add(i, {0.25 * i, 0.0, 2.3});
  EXPECT_NEAR(traversed.back_length_m(3.0), 3.0, 0.25);  // spacing of poses
}

TEST(TraversedPath, ReturnsPosesNearby) {
  TraversedPath traversed;
  for (int i = 0; i <= 80; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});              // to 20, 0
  for (int i = 1; i <= 72; ++i) traversed.add(80 + i, {20.0 - 0.25 * i, 1.0, 0.0});  // to 2, 1
  const auto near = traversed.poses_back_within(3.0);
  EXPECT_EQ(near.front(), Pose2(2.0, 1.0, 0.0));
  EXPECT_NEAR(near.back().x, 0.0, 1e-9);  // the first pose is the last
  for (const Pose2& pose : near)
    EXPECT_LE((pose.translation() - near[0].translation()).norm(), 3.0);
}

TEST(TraversedPath, MeasuresTheSharedLengthWithARoute) {
  TraversedPath traversed;
  for (int i = 0; i <= 40; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});  // to 10, 0
  const auto route = [](double x, double y) {
    std::vector<Eigen::Vector2d> places;
    const Eigen::Vector2d from(10.0, 0.0);
    for (int i = 0; i <= 20; ++i) places.emplace_back(from + i / 20.0 * Eigen::Vector2d(x, y));
    return places;
  };
  EXPECT_NEAR(traversed.shared_length_m(route(-10.0, 0.5)), 10.0,
              0.02);  // the route is oblique
  EXPECT_LT(traversed.shared_length_m(route(10.0, 0.0)),
            1.01);  // not driven: 1 m beside it
  EXPECT_LT(traversed.shared_length_m(route(0.0, 10.0)), 1.01);
}

TEST(TraversedPath, CountsTheLengthButNotThePosesOfAnotherOdomFrame) {
  TraversedPath traversed;
  for (int i = 0; i <= 8; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});
  traversed.reset({});
  EXPECT_TRUE(traversed.back(3.0).empty());
  EXPECT_DOUBLE_EQ(traversed.distance_travelled_m(), 2.0);
  traversed.add(9, {100.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(traversed.distance_travelled_m(), 2.0);
}

TEST(TraversedPath, LeadsBackIntoTheEarlierOdomFrameOnceAnchored) {
  const Pose2 T_map_before{10.0, 5.0, 0.3};
  const Pose2 T_map_odom{12.0, 4.0, -1.2};
  const Pose2 T_odom_before = between(T_map_odom, T_map_before);
  TraversedPath traversed;
  for (int i = 0; i <= 8; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});
  traversed.reset(T_map_before);
  traversed.add(9, T_odom_before * Pose2{2.25, 0.0, 0.0});
  traversed.add(10, T_odom_before * Pose2{2.5, 0.0, 0.0});
  EXPECT_EQ(traversed.back(3.0).size(), 3U);  // not anchored yet
  traversed.anchor(T_map_odom);
  traversed.anchor(T_map_odom);
  const auto path = traversed.back(3.0);
  for (std::size_t i = 2; i < path.size(); ++i) {
    const Eigen::Vector2d expected = T_odom_before * Eigen::Vector2d(2.75 - 0.25 * i, 0.0);
    EXPECT_LT((path[i].translation() - expected).norm(), 1e-9) << i;
  }
  EXPECT_EQ(path.size(), 12U);
}

TEST(TraversedPath, LosesPosesOfAFrameWithoutAMapCorrection) {
  TraversedPath traversed;
  for (int i = 0; i <= 8; ++i) traversed.add(i, {0.25 * i, 0.0, 0.0});
  traversed.reset({});
  traversed.add(9, {2.25, 0.0, 0.0});
  traversed.anchor({1.0, 0.0, 0.0});
  EXPECT_EQ(traversed.back(3.0).size(), 2U);
}

constexpr std::int64_t kOdom = 1'600'000'000'000'000;

TEST(StoredPath, RoundTripsThroughBytes) {
  for (const StoredPathPose& pose :
       {StoredPathPose{kOdom, {1.0, -2.0, 0.3}, {}, false},
        StoredPathPose{kOdom, {1.0, -2.0, 0.3}, Pose2{4.0, 5.0, -3.0}, true, -6.0, 0.4}}) {
    const auto bytes = to_bytes(pose);
    EXPECT_EQ(stored_path_pose_from(bytes), pose);
    EXPECT_FALSE(stored_path_pose_from(std::span(bytes).first(bytes.size() - 1)));
  }
}

TEST(StoredPath, EqualsTheDrivenPath) {
  TraversedPath driven;
  std::vector<StoredPathPose> stored;
  const auto drive = [&](double x, double y) {
    if (driven.add(0, {x, y, 0.0})) stored.push_back({kOdom, {x, y, 0.0}, {}, true});
  };
  for (int i = 0; i < 50; ++i) drive(0.1 * i, 0.0);
  for (int i = 0; i < 20; ++i) drive(5.0, 0.1 * i);
  for (int i = 20; i > 0; --i) drive(5.0, 0.1 * i);  // into a side tunnel and out again
  TraversedPath restored = traversed_path_from(stored);
  restored.add(0, *driven.T_odom_body());
  EXPECT_EQ(restored.back(100.0), driven.back(100.0));
  EXPECT_EQ(restored.distance_travelled_m(), driven.distance_travelled_m());
}

TEST(StoredPath, ContinuesIntoTheEarlierOdomFrame) {
  std::vector<StoredPathPose> stored;
  for (int i = 0; i < 10; ++i) stored.push_back({kOdom, {0.3 * i, 0.0, 0.0}, Pose2{}, true});
  const Pose2 T_map_odom{2.7, 0.0, 0.0};
  stored.push_back({kOdom + 1, {}, {}, false});
  EXPECT_EQ(traversed_path_from(stored).back(100.0).size(),
            2U);  // the newest pose and the stored one
  stored.push_back({kOdom + 1, {0.3, 0.0, 0.0}, T_map_odom, true});
  const auto back = traversed_path_from(stored).back(100.0);
  EXPECT_NEAR(back.back().x, -2.7, 1e-9);
}

}  // namespace
}  // namespace adit
