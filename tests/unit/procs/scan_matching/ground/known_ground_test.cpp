// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/known_ground.hpp"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

using Surface = KnownGround::Surface;

constexpr double kLevelM = 3.0;  // height of the frame of the terrain in odom

/// 10 m by 2 m ahead of a robot at (20, 5) that faces +y: ground that rises by 20 % under a roof at
/// 2 m, with a wall across it at 6 m.
TerrainMap ramp_with_wall() {
  TerrainMap map;
  map.T_odom_level = {20.0, 5.0, std::numbers::pi / 2.0};
  map.p_level_corner = {0.0, -1.0};
  map.cell_m = 0.1;
  map.cells = Grid2<TerrainCell>(100, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 100; ++column) {
      TerrainCell& cell = map.cells.at({column, row});
      cell.ground = Ground::kObserved;
      cell.low_m = static_cast<float>(0.2 * 0.1 * (column + 0.5));
      cell.coefficient_m = column == 60 ? 1.9F : 0.02F;
      cell.clearance_m = 2.0F;
    }
  }
  return map;
}

TEST(KnownGround, TellsGroundAndRoofFromWallsOnATerrainMap) {
  KnownGround ground;
  ground.add(ramp_with_wall(), kLevelM);
  // 3 m ahead of the robot the ground is at 0.6 m: a level beam of a laser at 0.6 m ends there.
  EXPECT_EQ(ground.surface_at({20.0, 8.05}, kLevelM + 0.61, 3.0), Surface::kGround);
  EXPECT_EQ(ground.surface_at({20.0, 8.05}, kLevelM + 1.2, 3.0), Surface::kUnknown);
  EXPECT_EQ(ground.surface_at({20.0, 8.05}, kLevelM + 2.55, 3.0), Surface::kRoof);
  EXPECT_EQ(ground.surface_at({20.0, 11.05}, kLevelM + 1.5, 6.0), Surface::kWall);
  EXPECT_EQ(ground.surface_at({20.0, 4.0}, kLevelM, 1.0), Surface::kUnknown);  // behind
}

TEST(KnownGround, DoesNotJudgeByGroundThatWasNotObserved) {
  TerrainMap map = ramp_with_wall();
  for (TerrainCell& cell : map.cells) {
    cell.ground = Ground::kOccluded;
    cell.low_m = std::numeric_limits<float>::quiet_NaN();
  }
  KnownGround ground;
  ground.add(map, kLevelM);
  EXPECT_EQ(ground.surface_at({20.0, 8.05}, kLevelM + 0.61, 3.0), Surface::kUnknown);
}

TEST(KnownGround, TakesNoFootOfAWallAndNothingAboveItsTopForAWall) {
  KnownGround ground;
  ground.add(ramp_with_wall(), kLevelM);
  // The wall at 6 m stands on ground at 1.21 m, and its observed top is at 3.11 m.
  const auto at = [&](double z_level_m) {
    return ground.surface_at({20.0, 11.05}, kLevelM + z_level_m, 6.0);
  };
  const double near_m = 0.15 + 0.01 * 6.0;
  EXPECT_EQ(at(1.21), Surface::kUnknown);
  EXPECT_EQ(at(1.21 + near_m - 0.01), Surface::kUnknown);
  EXPECT_EQ(at(1.21 + near_m + 0.01), Surface::kWall);
  EXPECT_EQ(at(3.11 + near_m - 0.01), Surface::kWall);
  EXPECT_EQ(at(3.11 + near_m + 0.01), Surface::kUnknown);
}

TEST(KnownGround, RemembersTheGroundThatWasDrivenOn) {
  KnownGround ground;
  for (int i = 0; i < 20; ++i) ground.add(Eigen::Vector2d(0.25 * i, 0.0), 0.05 * i);
  EXPECT_EQ(ground.surface_at({2.6, 0.1}, 0.55, 2.0), Surface::kGround);
  EXPECT_EQ(ground.surface_at({2.6, 0.1}, 1.2, 2.0), Surface::kUnknown);
  EXPECT_EQ(ground.surface_at({2.6, 3.0}, 0.55, 2.0), Surface::kUnknown);
  ground.clear();
  EXPECT_EQ(ground.surface_at({2.6, 0.1}, 0.55, 2.0), Surface::kUnknown);
}

TEST(KnownGround, DoesNotTakeWallsBelowAnotherLevelForGround) {
  KnownGround ground;
  ground.add(Eigen::Vector2d(1.0, 0.0), 0.0);
  EXPECT_EQ(ground.surface_at({1.0, 0.0}, -0.4, 5.0), Surface::kGround);
  EXPECT_EQ(ground.surface_at({1.0, 0.0}, -4.5, 5.0), Surface::kUnknown);
}

}  // namespace
}  // namespace adit
