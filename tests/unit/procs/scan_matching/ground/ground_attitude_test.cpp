// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/ground_attitude.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/worlds/rock_sweep.hpp"

namespace adit {
namespace {

constexpr double kGrade = 0.2;
constexpr double kFootM = 4.0;  // where it begins
constexpr double kStepM = 0.1;

double ramp_m(double x_m) { return kGrade * std::max(0.0, x_m - kFootM); }

/// What a 3D scan at x = 0 shows of level ground and the ramp ahead.
TerrainMap ramp_terrain() {
  TerrainMap terrain;
  terrain.utime = 1;
  terrain.p_level_corner = {-3.0, -2.0};
  terrain.cells = Grid2<TerrainCell>(150, 40);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 150; ++column) {
      TerrainCell& cell = terrain.cells.at({column, row});
      cell.ground = Ground::kObserved;
      cell.low_m = static_cast<float>(ramp_m(terrain.centre(column, row).x()));
    }
  }
  return terrain;
}

Cloud empty_cloud() {
  Cloud cloud;
  cloud.utime = 1;
  return cloud;
}

TEST(GroundAttitude, IsUnknownBeforeTheFirstScan) {
  GroundAttitude attitude{GroundAttitudeParams{}, Vehicle{}};
  attitude.drive({1.0, 0.0, 0.0});
  EXPECT_FALSE(attitude.attitude(0.0));
  EXPECT_FALSE(attitude.z_odom_m());
}

TEST(GroundAttitude, IsThatOfTheGroundUnderTheWheels) {
  GroundAttitude attitude{GroundAttitudeParams{}, Vehicle{}};
  attitude.add(empty_cloud(), 0.5);
  attitude.add(ramp_terrain(), 0.5);
  for (int i = 0; i < 30; ++i) attitude.drive({i * kStepM, 0.0, 0.0});
  EXPECT_NEAR(attitude.attitude(0.0)->pitch_rad, 0.0, 0.002);
  for (int i = 30; i < 80; ++i) attitude.drive({i * kStepM, 0.0, 0.0});
  // Half a cell over the wheelbase, averaged over nine cells: 0.2 · 0.05 / 1.5.
  EXPECT_NEAR(attitude.attitude(0.0)->pitch_rad, -std::atan(kGrade), 0.007);
  EXPECT_NEAR(attitude.attitude(0.0)->roll_rad, 0.0, 0.002);
  EXPECT_NEAR(*attitude.z_odom_m(), 0.5 + ramp_m(7.9), 0.02);
  // On the return path the slope falls, and across it the body rolls.
  attitude.drive({7.9, 0.0, 3.14159});
  EXPECT_NEAR(attitude.attitude(3.14159)->pitch_rad, std::atan(kGrade), 0.007);
  EXPECT_NEAR(attitude.attitude(1.5708)->roll_rad, -std::atan(kGrade), 0.007);
  for (int i = 79; i > 10; --i) attitude.drive({i * kStepM, 0.0, 3.14159});
  EXPECT_NEAR(attitude.attitude(3.14159)->pitch_rad, 0.0, 0.002);
  EXPECT_NEAR(*attitude.z_odom_m(), 0.5, 0.02);
}

TEST(GroundAttitude, IsCorrectedByTheMatchOfTwoScans) {
  GroundAttitude attitude{GroundAttitudeParams{}, Vehicle{}};
  Cloud first = test::sweep(test::rough_tunnel, test::pose(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 1);
  first.utime = 1;
  attitude.add(first, 0.0);
  // Taken for level at its own height, though it is 2 degrees steeper and lower.
  const Eigen::Isometry3d truth = test::pose(3.0, 0.0, -0.05, 0.02, 0.035, 0.0);
  Cloud second = test::sweep(test::rough_tunnel, truth, 2);
  second.utime = 2;
  second.T_odom_level = {3.0, 0.0, 0.0};
  attitude.add(second, 0.0);
  EXPECT_NEAR(attitude.attitude(0.0)->pitch_rad, 0.035, 0.003);
  EXPECT_NEAR(attitude.attitude(0.0)->roll_rad, 0.02, 0.003);
  EXPECT_NEAR(*attitude.z_odom_m(), -0.05, 0.02);
}

}  // namespace
}  // namespace adit
