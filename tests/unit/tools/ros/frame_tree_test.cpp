// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Frames, and level scans of lasers that are mounted somehow.
#include "tools/ros/import/frame_tree.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "tools/ros/import/level_scan.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kBegin = 1'700'000'000'000'000;

Eigen::Isometry3d pose(const Eigen::Vector3d& p, double roll, double pitch, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = p;
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

TEST(FrameTree, FindsPosesThroughACommonAncestor) {
  FrameTree tree;
  tree.add({0, "base_link", "laser", pose({1.0, 0.0, 0.5}, 0.0, 0.0, 0.3)}, true);
  tree.add({0, "base_link", "imu", pose({0.0, 0.2, 0.0}, 0.0, 0.0, -0.4)}, true);
  const auto T = tree.lookup("imu", "laser", kBegin);
  ASSERT_TRUE(T);
  const Eigen::Isometry3d expected =
      pose({0.0, 0.2, 0.0}, 0.0, 0.0, -0.4).inverse() * pose({1.0, 0.0, 0.5}, 0.0, 0.0, 0.3);
  EXPECT_TRUE(T->isApprox(expected, 1e-12));
  EXPECT_FALSE(tree.lookup("camera", "laser", kBegin));
  EXPECT_FALSE(tree.moves("imu", "laser"));
}

TEST(FrameTree, InterpolatesPosesThatMove) {
  FrameTree tree;
  for (int i = 0; i < 4; ++i)  // at rest for 2 s, then 1 m and 0.2 rad in one
    tree.add({kBegin + i * 1'000'000, "odom", "base_link",
              pose({i == 3 ? 1.0 : 0.0, 0.0, 0.0}, 0.0, 0.0, i == 3 ? 0.2 : 0.0)},
             false);
  EXPECT_TRUE(tree.moves("odom", "base_link"));
  EXPECT_NEAR(tree.lookup("odom", "base_link", kBegin + 1'900'000)->translation().x(), 0.0, 1e-12);
  const auto T = tree.lookup("odom", "base_link", kBegin + 2'250'000);
  EXPECT_NEAR(T->translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(in_plan(*T).theta, 0.05, 1e-12);
  EXPECT_EQ(tree.rigid_root("base_link"), "base_link");
}

TEST(FrameTree, SurvivesACycle) {
  FrameTree tree;
  tree.add({0, "a", "b", Eigen::Isometry3d::Identity()}, true);
  tree.add({0, "b", "a", Eigen::Isometry3d::Identity()}, true);
  EXPECT_FALSE(tree.lookup("a", "c", 0));
  EXPECT_FALSE(tree.rigid_root("a").empty());
}

/// Points of a level wall that the laser measures must lie where they are, however it is mounted.
class MountedLaser : public testing::TestWithParam<double> {};

TEST_P(MountedLaser, GivesTheSamePoints) {
  const Eigen::Isometry3d T_body_laser = pose({0.5, -0.1, 0.4}, GetParam(), 0.0, 0.7);
  RosLaserScan scan;
  scan.angle_min_rad = -1.0;
  scan.angle_step_rad = 0.1;
  for (int i = 0; i < 21; ++i) scan.ranges_m.push_back(2.0F + 0.1F * static_cast<float>(i));
  const auto mount = LevelMount::of(T_body_laser);
  ASSERT_TRUE(mount);
  EXPECT_EQ(mount->upside_down, GetParam() > 1.0);
  EXPECT_DOUBLE_EQ(mount->mount.height_m, 0.4);
  const auto level = level_scan(scan, mount->upside_down);
  ASSERT_TRUE(level);
  ASSERT_EQ(level->ranges_m.size(), 21U);
  for (int i = 0; i < 21; ++i) {
    const double bearing = scan.angle_min_rad + 0.1 * i;
    const double range = scan.ranges_m[static_cast<std::size_t>(i)];
    const Eigen::Vector3d p_body =
        T_body_laser * Eigen::Vector3d(range * std::cos(bearing), range * std::sin(bearing), 0.0);
    const int beam = mount->upside_down ? 20 - i : i;
    const double angle = level->angle_min_rad + beam * level->angle_step_rad;
    const double level_range = level->ranges_m[static_cast<std::size_t>(beam)];
    const Eigen::Vector2d p =
        mount->mount.T_body_laser *
        Eigen::Vector2d(level_range * std::cos(angle), level_range * std::sin(angle));
    EXPECT_LT((p - p_body.head<2>()).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(UprightAndUpsideDown, MountedLaser, testing::Values(0.0, kPi));

TEST(LevelMount, IsNoneForALaserThatLooksDown) {
  EXPECT_FALSE(LevelMount::of(pose({0.0, 0.0, 0.0}, 0.0, 0.5, 0.0)));
  EXPECT_FALSE(LevelMount::of(pose({0.0, 0.0, 0.0}, 0.5 * kPi, 0.0, 0.0)));
}

TEST(LevelScan, TurnsAClockwiseScan) {
  RosLaserScan scan;
  scan.angle_min_rad = 1.0;
  scan.angle_step_rad = -0.5;
  scan.ranges_m = {1.0F, 2.0F, 3.0F};
  const auto level = level_scan(scan, false);
  ASSERT_TRUE(level);
  EXPECT_THAT(level->ranges_m, ElementsAre(3.0F, 2.0F, 1.0F));
  EXPECT_DOUBLE_EQ(level->angle_min_rad, 0.0);
  EXPECT_DOUBLE_EQ(level->angle_step_rad, 0.5);
}

/// A circle of radius 5 m around the sensor, a roof above it and a nearer post.
TEST(LevelScan, TakesTheNearestPointsOfTheSlice) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 3600; ++i) {
    const float angle = static_cast<float>(i) * static_cast<float>(kPi) / 1800.0F;
    points.emplace_back(5.0F * std::cos(angle), 5.0F * std::sin(angle), 0.05F);
    points.emplace_back(1.0F * std::cos(angle), 1.0F * std::sin(angle), 0.9F);
  }
  points.emplace_back(0.0F, 2.0F, 0.0F);
  const LaserScan scan = level_scan(points);
  ASSERT_EQ(scan.ranges_m.size(), 1440U);
  int nearer = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double bearing = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    if (scan.ranges_m[i] < 4.0F) {
      EXPECT_NEAR(bearing, 0.5 * kPi, scan.angle_step_rad);
      EXPECT_FLOAT_EQ(scan.ranges_m[i], 2.0F);
      ++nearer;
    } else {
      EXPECT_NEAR(scan.ranges_m[i], 5.0F, 1e-4F);
    }
  }
  EXPECT_EQ(nearer, 1);
  EXPECT_TRUE(std::isnan(level_scan(std::vector<Eigen::Vector3f>()).ranges_m[0]));
}

}  // namespace
}  // namespace adit
