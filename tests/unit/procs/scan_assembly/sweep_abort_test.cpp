// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Sweeps that do not come to their end, and readings that are not to be used.
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/procs/scan_assembly/sweeping_robot.hpp"

namespace adit {
namespace {

using test::assembly_params;
using test::kStart;
using test::largest_error;
using test::perfect_laser;
using test::SweepingRobot;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDuringSweepS = 6.0;  // the sweep lasts from 3.3 s to 9.8 s

const BoxTunnel kTunnel;

/// A body that starts to drive at a time.
SweepingRobot::PoseAt drives_from(double begin_s) {
  return [begin_s](double seconds) {
    Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
    T_world_body.translation().x() = 0.2 * std::max(0.0, seconds - begin_s);
    return T_world_body;
  };
}

void expect_partial_cloud(const std::optional<Cloud>& cloud) {
  ASSERT_TRUE(cloud);
  EXPECT_FALSE(cloud->complete);
  EXPECT_GT(cloud->lines.size(), 90U);
  EXPECT_LT(cloud->lines.size(), 130U);
  // As in scan_assembly_test.cpp.
  EXPECT_LE(largest_error(kTunnel, *cloud), 0.001);
}

TEST(SweepAbort, PublishesAnIncompleteCloudWhenTheRobotMoves) {
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), drives_from(kDuringSweepS));
  ScanAssembly assembly(assembly_params());
  expect_partial_cloud(robot.sweep(assembly));
  EXPECT_EQ(assembly.problem(), "the robot moved");
  EXPECT_NEAR(robot.tilt_rad(), 0.0, 1e-6);
}

TEST(SweepAbort, PublishesAnIncompleteCloudWhenTheLaserTimesOut) {
  SweepingRobot robot(box_tunnel(kTunnel));
  robot.delivers_scans = [](double seconds) { return seconds < kDuringSweepS; };
  ScanAssembly assembly(assembly_params());
  expect_partial_cloud(robot.sweep(assembly));
  EXPECT_EQ(assembly.problem(), "scans of the front laser timed out");
}

TEST(SweepAbort, PublishesAnIncompleteCloudWhenTheTiltTimesOut) {
  SweepingRobot robot(box_tunnel(kTunnel));
  robot.delivers_tilts = [](double seconds) { return seconds < kDuringSweepS; };
  ScanAssembly assembly(assembly_params());
  expect_partial_cloud(robot.sweep(assembly));
  EXPECT_EQ(assembly.problem(), "tilt of the front laser timed out");
}

TEST(SweepAbort, PublishesNoCloudBeforeTheFirstLine) {
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), drives_from(2.2));
  ScanAssembly assembly(assembly_params());
  EXPECT_FALSE(robot.sweep(assembly));
  EXPECT_EQ(assembly.problem(), "the robot moved");
}

TEST(SweepAbort, TimesOutIfTheLaserDoesNotMove) {
  SweepingRobot robot(box_tunnel(kTunnel));
  robot.delivers_commands = [](double) { return false; };
  ScanAssembly assembly(assembly_params());
  EXPECT_FALSE(robot.sweep(assembly, 20.0));
  EXPECT_EQ(assembly.problem(), "the sweep timed out");
}

TEST(SweepAbort, DoesNotAffectTheNextSweep) {
  SweepingRobot robot(box_tunnel(kTunnel), perfect_laser(), drives_from(1e9));
  robot.delivers_scans = [](double) { return false; };
  ScanAssembly assembly(assembly_params());
  EXPECT_FALSE(robot.sweep(assembly));
  SweepingRobot other(box_tunnel(kTunnel));
  const auto cloud = other.sweep(assembly);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->complete);
  EXPECT_EQ(assembly.problem(), "");
}

TEST(ScanRequest, IsRejectedWithoutAPose) {
  ScanAssembly assembly(assembly_params());
  assembly.begin({kStart, 1, LaserId::kFront}, kStart);
  EXPECT_EQ(assembly.problem(), "request rejected: no pose received yet");
  EXPECT_FALSE(assembly.advance(kStart).command);
}

TEST(ScanRequest, IsRejectedDuringASweep) {
  ScanAssembly assembly(assembly_params());
  assembly.add(kStart, Pose2{}, 0.0);
  assembly.begin({kStart, 1, LaserId::kFront}, kStart);
  EXPECT_TRUE(assembly.advance(kStart).command);
  assembly.begin({kStart, 2, LaserId::kRear}, kStart);
  EXPECT_EQ(assembly.problem(), "request rejected: a sweep is in progress");
  EXPECT_EQ(assembly.laser(), LaserId::kFront);
}

TEST(SweepInput, RejectsReadingsThatAreNotFinite) {
  ScanAssembly assembly(assembly_params());
  EXPECT_FALSE(assembly.add(kStart, Pose2{0.0, kNaN, 0.0}, 0.0));
  EXPECT_FALSE(assembly.add(kStart, Pose2{}, kNaN));
  EXPECT_FALSE(assembly.add(ImuReading{kStart, {}, {0.0, kNaN, 9.81}}));
  assembly.add(kStart, Pose2{}, 0.0);
  assembly.begin({kStart, 1, LaserId::kFront}, kStart);
  EXPECT_FALSE(assembly.add(LaserId::kFront, TiltReading{kStart, kNaN, 0.0}));
  EXPECT_TRUE(assembly.add(LaserId::kFront, TiltReading{kStart, 0.1, kNaN}));
}

/// An assembly during a sweep.
ScanAssembly sweeping() {
  ScanAssembly assembly(assembly_params());
  assembly.add(kStart, Pose2{}, 0.0);
  assembly.begin({kStart, 1, LaserId::kFront}, kStart);
  assembly.advance(kStart);
  assembly.add(LaserId::kFront, TiltReading{kStart, -0.5, 0.0});
  assembly.add(LaserId::kFront, TiltReading{kStart + 20'000, -0.5, 0.0});
  EXPECT_TRUE(assembly.advance(kStart + 20'000).command);
  return assembly;
}

TEST(SweepInput, RejectsScansThatDoNotAdvanceInTimeOrAreOfAnotherLaser) {
  ScanAssembly assembly = sweeping();
  const LaserScan scan{kStart + 30'000, std::vector<float>(361, 2.0F), -1.57, 0.0087};
  EXPECT_FALSE(assembly.add(LaserId::kRear, scan));
  EXPECT_TRUE(assembly.add(LaserId::kFront, scan));
  EXPECT_FALSE(assembly.add(LaserId::kFront, scan));
  EXPECT_FALSE(assembly.add(LaserId::kFront, {kStart + 60'000, {2.0F}, kNaN, 0.0087}));
}

TEST(SweepInput, InvalidRangesAreNeitherPointsNorMisses) {
  ScanAssembly assembly = sweeping();
  const float invalid = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  assembly.add(
      LaserId::kFront,
      {kStart + 30'000, {invalid, 0.0F, -infinite, -1.0F, infinite, 8.5F, 2.0F}, 0.0, 0.01});
  assembly.add(LaserId::kFront, TiltReading{kStart + 500'000, -0.4, 0.0});
  const auto cloud = assembly.advance(kStart + 30'000'000).cloud;  // after the timeout
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->lines.size(), 1U);
  EXPECT_EQ(cloud->lines[0].points.size(), 1U);
  EXPECT_EQ(cloud->lines[0].misses.size(), 2U);
}

}  // namespace
}  // namespace adit
