// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/obstacle_parts.hpp"

#include <gtest/gtest.h>

#include "procs/terrain/memory/remembered_map.hpp"

namespace adit {
namespace {

/// Level ground of 4 × 4 cells of 0.1 m from the origin on.
TerrainMap level_ground() {
  TerrainMap map;
  TerrainCell ground;
  ground.ground = Ground::kObserved;
  map.cells = Grid2<TerrainCell>(4, 4, ground);
  return map;
}

TEST(ObstacleParts, HoldThePointsThatBlockTheVehicle) {
  TerrainMap map = level_ground();
  map.cells.at({3, 3}).ground = Ground::kNeverObserved;
  Cloud cloud;
  cloud.lines.resize(1);
  cloud.lines[0].points = {{0.13F, 0.26F, 0.5F},    // part (1, 2) of cell (1, 2)
                           {0.199F, 0.201F, 1.1F},  // too low a roof: part (3, 0)
                           {0.01F, 0.01F, 0.1F},    // rough ground
                           {0.02F, 0.02F, 1.3F},    // roof
                           {0.35F, 0.35F, 0.5F}};   // over unobserved ground
  set_obstacle_parts(map, cloud, Vehicle{});
  EXPECT_EQ(map.cells.at({1, 2}).obstacle_parts, (1U << (4 * 2 + 1)) | (1U << 3));
  EXPECT_EQ(map.cells.at({0, 0}).obstacle_parts, 0);
  EXPECT_EQ(map.cells.at({3, 3}).obstacle_parts, 0);
}

TEST(ObstacleParts, AreRememberedWhereTheyStood) {
  TerrainMap map = level_ground();
  map.cells.at({1, 2}).obstacle_parts = CellParts::bit_at(0.3, 0.6);
  const RememberedMap remembered(map, 0.0);
  EXPECT_TRUE(remembered.has_obstacle_at({0.13, 0.26}));
  EXPECT_FALSE(remembered.has_obstacle_at({0.16, 0.26}));
  EXPECT_FALSE(remembered.has_obstacle_at({0.23, 0.26}));
  EXPECT_FALSE(remembered.has_obstacle_at({-0.2, 0.0}));
}

}  // namespace
}  // namespace adit
