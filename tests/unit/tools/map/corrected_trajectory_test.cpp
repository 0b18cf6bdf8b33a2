// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "tools/map/full_map.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

/// Straight along x, 0.1 m per second.
Trajectory straight(int poses) {
  Trajectory odometry;
  for (int i = 0; i < poses; ++i) odometry.push_back({kStart + i * kSecond, {0.1 * i, 0.0, 0.0}});
  return odometry;
}

MapAnchor anchor(const TimedPose& local, const Pose2& T_map_odom) {
  return {local.utime, local.pose, T_map_odom * local.pose};
}

void expect_near(const Pose2& a, const Pose2& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_diff(a.theta, b.theta), 0.0, tolerance);
}

TEST(CorrectedTrajectory, IsOdometryWithoutLocalMaps) {
  EXPECT_EQ(corrected_trajectory(straight(5), {}), straight(5));
  EXPECT_TRUE(corrected_trajectory({}, {anchor({kStart, {}}, {1, 2, 3})}).empty());
}

TEST(CorrectedTrajectory, AppliesAConstantCorrectionToAllPoses) {
  const Trajectory odometry = straight(20);
  const Pose2 T_map_odom{3.0, -2.0, 1.0};
  const auto corrected = corrected_trajectory(
      odometry, {anchor(odometry[4], T_map_odom), anchor(odometry[12], T_map_odom)});
  ASSERT_EQ(corrected.size(), odometry.size());
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    EXPECT_EQ(corrected[i].utime, odometry[i].utime);
    expect_near(corrected[i].pose, T_map_odom * odometry[i].pose);
  }
}

TEST(CorrectedTrajectory, PassesThroughThePosesOfTheLocalMaps) {
  const Trajectory odometry = straight(31);
  const std::vector<MapAnchor> anchors{anchor(odometry[0], {}),
                                       anchor(odometry[10], {0.2, 0.1, 0.05}),
                                       anchor(odometry[20], {0.1, 0.3, 0.1})};
  const auto corrected = corrected_trajectory(odometry, anchors);
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    expect_near(corrected[10 * k].pose, anchors[k].T_map_local);
  }
  const Pose2 last{0.1, 0.3, 0.1};  // applies until the end
  expect_near(corrected[30].pose, last * odometry[30].pose);
}

TEST(CorrectedTrajectory, IsContinuousFarFromTheOrigin) {
  Trajectory odometry = straight(41);
  for (TimedPose& at : odometry) at.pose = Pose2{500.0, 800.0, 2.0} * at.pose;
  const Pose2 turned{9.0, -4.0, 0.01};
  const auto corrected =
      corrected_trajectory(odometry, {anchor(odometry[0], {}), anchor(odometry[40], turned)});
  // The correction moves the last pose by about 10 m, and each of 40 steps by 1/40 of that.
  const double moved =
      (corrected.back().pose.translation() - odometry.back().pose.translation()).norm();
  for (std::size_t i = 1; i < corrected.size(); ++i) {
    const double step =
        (corrected[i].pose.translation() - corrected[i - 1].pose.translation()).norm();
    EXPECT_LT(step, 0.1 + 1.01 * moved / 40.0);
  }
}

TEST(CorrectedTrajectory, DoesNotMoveWhileTheBodyRests) {
  Trajectory odometry = straight(11);
  for (int i = 1; i <= 100; ++i) {
    odometry.push_back({odometry[10].utime + i * kSecond, odometry[10].pose});
  }
  for (int i = 1; i <= 10; ++i) {
    odometry.push_back({odometry[110].utime + i * kSecond, {1.0 + 0.1 * i, 0.0, 0.0}});
  }
  const auto corrected = corrected_trajectory(
      odometry, {anchor(odometry[0], {}), anchor(odometry[120], {0.0, 0.4, 0.0})});
  for (std::size_t i = 10; i <= 110; ++i) expect_near(corrected[i].pose, {1.0, 0.2, 0.0});
}

TEST(CorrectedTrajectory, BlendsAnglesByTheShortestRotation) {
  Trajectory odometry = straight(11);
  const auto corrected = corrected_trajectory(
      odometry, {anchor(odometry[0], {0.0, 0.0, 3.1}), anchor(odometry[10], {0.0, 0.0, -3.1})});
  for (const TimedPose& at : corrected) EXPECT_GE(std::abs(at.pose.theta), 3.1 - 1e-12);
}

}  // namespace
}  // namespace adit
