// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/local_map_tile.hpp"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// One beam ahead, from these places along x to a wall.
std::optional<LocalMapTile> tile_of_a_wall(double wall_m, const std::vector<double>& from_m) {
  LocalMap map;
  for (const double x_m : from_m) {
    map.scans.push_back(
        {"LASER_FRONT", {1, {static_cast<float>(wall_m - x_m)}, 0.0, 0.01}, {x_m, 0.1, 0.0}});
  }
  return make_local_map_tile(map, Lasers{}, LocalMapTileParams{});
}

TEST(LocalMapTile, TakesForSteepTheWallsThatWereSeenFromNearby) {
  const auto is_steep = [](const std::optional<LocalMapTile>& tile) {
    EXPECT_TRUE(tile);
    EXPECT_EQ(tile->walls.size(), 1U);
    return tile->walls.at(0).steep;
  };
  EXPECT_FALSE(is_steep(tile_of_a_wall(5.1, {0.0})));
  EXPECT_FALSE(is_steep(tile_of_a_wall(5.1, {0.0, 1.0, 3.3})));  // 1.8 m
  EXPECT_TRUE(is_steep(tile_of_a_wall(5.1, {3.5})));             // 1.6 m
  EXPECT_TRUE(is_steep(tile_of_a_wall(5.1, {3.5, 2.0, 0.0})));   // once is enough
}

}  // namespace
}  // namespace adit
