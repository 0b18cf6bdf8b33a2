// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/ground_shape.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// 12 × 12 cells of 0.1 m, seen from column 3 on.
TerrainMap edge_of_sight(const std::function<float(int column, int row)>& low_m) {
  TerrainMap map;
  map.columns = 12;
  map.rows = 12;
  map.cells.resize(144);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 3; column < map.columns; ++column) {
      TerrainCell& cell = map.at(column, row);
      cell.ground = Ground::kSeen;
      cell.low_m = low_m(column, row);
    }
  }
  set_slope_and_step(map);
  return map;
}

TEST(GroundShape, RailsThatAreSeenAloneAtTheEdgeOfSightAreNoSlope) {
  const TerrainMap map = edge_of_sight([](int column, int) { return column <= 4 ? 0.11F : 0.0F; });
  for (int column = 3; column < 10; ++column) {
    const float slope_rad = map.at(column, 6).slope_rad;
    EXPECT_TRUE(std::isnan(slope_rad) || slope_rad < 0.35F) << column;  // what a robot drives on
  }
  EXPECT_FLOAT_EQ(map.at(4, 6).step_m, 0.11F);
}

TEST(GroundShape, ARampIsASlopeTwoCellsFromTheEdgeOfSight) {
  const TerrainMap map =
      edge_of_sight([](int column, int) { return 0.05F * static_cast<float>(column); });
  EXPECT_TRUE(std::isnan(map.at(4, 6).slope_rad));
  for (int column = 5; column < 10; ++column) {
    EXPECT_NEAR(map.at(column, 6).slope_rad, std::atan(0.5), 1e-5);  // of floats
  }
}

}  // namespace
}  // namespace adit
