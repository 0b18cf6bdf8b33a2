// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Power loss of the complete computer during a drive: after the restart, the robot is localized
// where it stands. More cases: power_loss_table.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "tests/support/drives/power_loss_drive.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using enum test::DiskAfterPowerLoss;

constexpr double kErrorMaxM = 0.3;
constexpr double kErrorMaxRad = 3.0 / 180.0 * std::numbers::pi;
constexpr double kSigmas = 3.0;

/// A T junction, or a smooth tunnel with its ends out of range, where scan matching is degenerate.
World mine(bool smooth) {
  WorldDescription description;
  description.name = "tunnels";
  description.T_world_start = {smooth ? 90.0 : 5.0, 0.0, 0.0};
  if (smooth) {
    description.plan.tunnels = {{"long", {0, 0, 200, 0}, 3.2, false}};
    description.wall_relief.height_m = 0.0;
    description.heights.floor_relief.height_m = 0.0;
    description.heights.roof_relief.height_m = 0.0;
  } else {
    description.plan.tunnels = {{"main", {0, 0, 25, 0}, 3.5, false},
                                {"cross", {25, -15, 25, 20}, 3.5, false}};
  }
  return build_world(description);
}

std::vector<Waypoint> waypoints(const std::vector<Eigen::Vector2d>& positions) {
  std::vector<Waypoint> waypoints;
  for (const Eigen::Vector2d& p_world : positions) waypoints.push_back({p_world, {}});
  return waypoints;
}

void expect_localized(const test::PowerLoss& loss) {
  ASSERT_TRUE(loss.localized_after_s);
  EXPECT_LT(*loss.localized_after_s, 1.0);  // simulated time; half a second of scans
  EXPECT_LT(loss.error_m, kErrorMaxM);
  EXPECT_LT(loss.error_rad, kErrorMaxRad);
  EXPECT_LT(loss.sd_m, 0.1);
  EXPECT_EQ(loss.maps_lost, 0);
}

TEST(PowerLoss, LosesNoDataAndLocalizesTheRobot) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerLossDrive drive(mine(false), waypoints({{23, 0}, {25, 2}, {25, 18}}), scratch / "");
  ASSERT_TRUE(drive.drive(0.3));
  expect_localized(drive.lose_power(kIntact, random));  // at the start
  ASSERT_TRUE(drive.drive(8.0));
  drive.sweep();
  const test::PowerLoss at_rest = drive.lose_power(kIntact, random);
  expect_localized(at_rest);
  EXPECT_EQ(at_rest.scans, 1);
  EXPECT_EQ(at_rest.scans_lost, 0);
  ASSERT_TRUE(drive.drive(14.0));  // around the corner
  const test::PowerLoss truncated = drive.lose_power(kTruncated, random);
  expect_localized(truncated);
  EXPECT_EQ(truncated.scans_lost, 0);  // the torn record is that of the computation time
  drive.sweep(4.0);
  expect_localized(drive.lose_power(kIntact, random));  // with one laser tilted
}

/// The volume map has not received the scan, or has not written it yet.
TEST(PowerLoss, RecoversAScanThatWasJustPublished) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerLossDrive drive(mine(false), waypoints({{23, 0}, {25, 2}, {25, 18}}), scratch / "");
  ASSERT_TRUE(drive.drive(8.0));
  drive.sweep(0.0);
  for (int i = 0; i < 1000 && drive.volume().volumes().empty(); ++i) drive.wait(0.02);
  ASSERT_EQ(drive.volume().volumes().size(), 1U);
  const Pose2 before = drive.volume().volumes().front().T_map_volume.plan;
  EXPECT_EQ(drive.lose_power(kBeforeLastScan, random).scans_lost, 1);
  drive.wait(10.0);
  ASSERT_EQ(drive.volume().volumes().size(), 1U);
  EXPECT_EQ(drive.volume().excluded(), 0);
  const Pose2 after = drive.volume().volumes().front().T_map_volume.plan;
  EXPECT_LT(between(before, after).translation().norm(), 0.05);
  EXPECT_LT(std::abs(between(before, after).theta), 0.01);
}

TEST(PowerLoss, ReportsTheUncertaintyAlongASmoothTunnel) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerLossDrive drive(mine(true), waypoints({{195, 0}}), scratch / "");
  ASSERT_TRUE(drive.drive(12.0));
  const test::PowerLoss loss = drive.lose_power(kIntact, random);
  ASSERT_TRUE(loss.localized_after_s);
  EXPECT_GT(loss.sd_m, 0.5);
  EXPECT_LT(loss.error_m, kSigmas * loss.sd_m);
  EXPECT_LT(loss.error_rad, kErrorMaxRad);
  EXPECT_EQ(loss.maps_lost, 0);
}

}  // namespace
}  // namespace adit
