// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The whole computer is cut off at a moment of a drive, and finds itself where it stands. More of
// it: power_cuts_table.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "tests/support/power_cut_drive.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using enum test::DiskAfterCut;

constexpr double kFoundM = 0.3;
constexpr double kFoundRad = 3.0 / 180.0 * std::numbers::pi;
constexpr double kSigmas = 3.0;

/// A T, or a smooth drift that tells nobody how far along it is, with its ends out of sight.
World mine(bool smooth) {
  WorldDescription description;
  description.name = "drifts";
  description.T_world_start = {smooth ? 90.0 : 5.0, 0.0, 0.0};
  if (smooth) {
    description.plan.drifts = {{"long", {0, 0, 200, 0}, 3.2, false}};
    description.wall_relief.height_m = 0.0;
    description.heights.floor_relief.height_m = 0.0;
    description.heights.roof_relief.height_m = 0.0;
  } else {
    description.plan.drifts = {{"main", {0, 0, 25, 0}, 3.5, false},
                               {"cross", {25, -15, 25, 20}, 3.5, false}};
  }
  return build_world(description);
}

std::vector<Waypoint> waypoints(const std::vector<Eigen::Vector2d>& places) {
  std::vector<Waypoint> waypoints;
  for (const Eigen::Vector2d& p_world : places) waypoints.push_back({p_world, {}});
  return waypoints;
}

void expect_found(const test::PowerCut& cut) {
  ASSERT_TRUE(cut.found_s);
  EXPECT_LT(*cut.found_s, 1.0);  // of simulated time: half a second of scans
  EXPECT_LT(cut.error_m, kFoundM);
  EXPECT_LT(cut.error_rad, kFoundRad);
  EXPECT_LT(cut.sd_m, 0.1);
  EXPECT_EQ(cut.maps_lost, 0);
}

TEST(PowerCut, LosesNothingAndFindsTheBodyWhereItStands) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerCutDrive drive(mine(false), waypoints({{23, 0}, {25, 2}, {25, 18}}), scratch / "");
  ASSERT_TRUE(drive.drive(0.3));
  expect_found(drive.cut(kWhole, random));  // where it began is home
  ASSERT_TRUE(drive.drive(8.0));
  drive.sweep();
  const test::PowerCut at_rest = drive.cut(kWhole, random);
  expect_found(at_rest);
  EXPECT_EQ(at_rest.scans, 1);
  EXPECT_EQ(at_rest.scans_lost, 0);
  ASSERT_TRUE(drive.drive(14.0));  // round the corner
  const test::PowerCut torn = drive.cut(kTorn, random);
  expect_found(torn);
  EXPECT_EQ(torn.scans_lost, 0);  // the record that was torn is that of its time
  drive.sweep(4.0);
  expect_found(drive.cut(kWhole, random));  // with one laser tilted
}

/// The volume had not heard of it, or had not written it yet.
TEST(PowerCut, LosesNoScanThatWasJustAnnounced) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerCutDrive drive(mine(false), waypoints({{23, 0}, {25, 2}, {25, 18}}), scratch / "");
  ASSERT_TRUE(drive.drive(8.0));
  drive.sweep(0.0);
  for (int i = 0; i < 1000 && drive.volume().volumes().empty(); ++i) drive.wait(0.02);
  ASSERT_EQ(drive.volume().volumes().size(), 1U);
  const Pose2 before = drive.volume().volumes().front().T_map_volume;
  EXPECT_EQ(drive.cut(kBeforeTheScan, random).scans_lost, 1);
  drive.wait(10.0);
  ASSERT_EQ(drive.volume().volumes().size(), 1U);
  EXPECT_EQ(drive.volume().left_out(), 0);
  const Pose2 after = drive.volume().volumes().front().T_map_volume;
  EXPECT_LT(between(before, after).translation().norm(), 0.05);
  EXPECT_LT(std::abs(between(before, after).theta), 0.01);
}

TEST(PowerCut, SaysHowFarItMayBeAlongASmoothDrift) {
  const test::ScratchFolder scratch;
  std::mt19937 random(1);
  test::PowerCutDrive drive(mine(true), waypoints({{195, 0}}), scratch / "");
  ASSERT_TRUE(drive.drive(12.0));
  const test::PowerCut cut = drive.cut(kWhole, random);
  ASSERT_TRUE(cut.found_s);
  EXPECT_GT(cut.sd_m, 0.5);
  EXPECT_LT(cut.error_m, kSigmas * cut.sd_m);
  EXPECT_LT(cut.error_rad, kFoundRad);
  EXPECT_EQ(cut.maps_lost, 0);
}

}  // namespace
}  // namespace adit
