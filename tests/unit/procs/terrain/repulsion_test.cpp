// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/repulsion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr int kSide = 41;
constexpr int kMiddle = 20;

TerrainMap level_map() {
  TerrainMap map;
  map.columns = kSide;
  map.rows = kSide;
  map.cells.resize(kSide * kSide);
  return map;
}

TEST(Repulsion, FallsWithTheDistanceFromAnObstacleAndEndsAtTheRadius) {
  TerrainMap map = level_map();
  map.at(kMiddle, kMiddle).coefficient_m = 0.8F;
  set_repulsion(map, {.radius_m = 0.5});
  const float peak = map.at(kMiddle, kMiddle).repulsion_m;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double distance_m = 0.1 * std::hypot(column - kMiddle, row - kMiddle);
      const double cone = std::max(0.0, 1.0 - distance_m / 0.5);
      EXPECT_NEAR(map.at(column, row).repulsion_m, peak * cone, 1e-6);  // float
    }
  }
}

TEST(Repulsion, AtTheFootOfAWallIsItsCoefficient) {
  TerrainMap map = level_map();
  for (int row = 0; row < kSide; ++row) {
    for (int column = kMiddle; column < kSide; ++column) map.at(column, row).coefficient_m = 0.6F;
  }
  set_repulsion(map, {});
  EXPECT_NEAR(map.at(kMiddle, kMiddle).repulsion_m, 0.6, 1e-5);  // float
  EXPECT_GT(map.at(kMiddle - 2, kMiddle).repulsion_m, 0.0F);
  EXPECT_EQ(map.at(kMiddle - 5, kMiddle).repulsion_m, 0.0F);
}

TEST(Repulsion, NeitherPebblesNorTheUnknownRepel) {
  TerrainMap map = level_map();
  map.at(5, 5).coefficient_m = 0.04F;
  map.at(30, 30).coefficient_m = std::numeric_limits<float>::quiet_NaN();
  set_repulsion(map, {});
  EXPECT_TRUE(std::all_of(map.cells.begin(), map.cells.end(),
                          [](const TerrainCell& cell) { return cell.repulsion_m == 0.0F; }));
}

TEST(Repulsion, OfNoRadiusStaysWhereItIs) {
  TerrainMap map = level_map();
  map.at(0, 0).coefficient_m = 0.3F;
  set_repulsion(map, {.radius_m = 0.0});
  EXPECT_NEAR(map.at(0, 0).repulsion_m, 0.3, 1e-6);
  EXPECT_EQ(map.at(1, 0).repulsion_m, 0.0F);
}

}  // namespace
}  // namespace adit
