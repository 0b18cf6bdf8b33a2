// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/map_changes.hpp"

#include <gtest/gtest.h>

#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

const OccupancyGridParams kGrid{.resolution_m = 0.1};

/// What a robot sees that drives through a room of 16 m by 8 m, `offset_m` beside where it thinks
/// it is, with a block of 1.2 m by 1 m in it or not.
OccupancyGrid seen(bool with_block, double offset_m = 0.0, double to_m = 5.0) {
  std::vector<test::Segment> walls;
  test::add_closed(walls, {{-8, -4}, {8, -4}, {8, 4}, {-8, 4}});
  if (with_block) test::add_closed(walls, {{2, 1.5}, {2, 2.5}, {3.2, 2.5}, {3.2, 1.5}});
  const test::WallWorld world(walls);
  test::LevelLaser laser(world, 1);
  OccupancyGrid grid(kGrid);
  for (double x = -7.0; x <= to_m; x += 0.3) {
    for (const double heading : {0.0, 3.14159}) {
      const LaserScan scan = laser.measure({x, offset_m, heading}, 1'000'000);
      EXPECT_TRUE(grid.insert(scan, {x, 0.0, heading}));
    }
  }
  return grid;
}

TEST(MapChanges, FindsAFallWhereItIsAndBetweenWhichRuns) {
  const auto changes = find_changes({seen(false), seen(false), seen(true)}, {});
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MapChange::Kind::kAppeared);
  EXPECT_EQ(changes[0].wall_runs, (std::vector<std::size_t>{2}));
  EXPECT_EQ(changes[0].free_runs, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(changes[0].p_map.x(), 2.6, 0.4);  // the robot sees the sides that face its path
  EXPECT_NEAR(changes[0].p_map.y(), 1.7, 0.4);
}

TEST(MapChanges, TellsWhatVanishedAndWhatComesAndGoes) {
  const auto vanished = find_changes({seen(true), seen(false)}, {});
  ASSERT_EQ(vanished.size(), 1U);
  EXPECT_EQ(vanished[0].kind, MapChange::Kind::kVanished);
  const auto differs = find_changes({seen(false), seen(true), seen(false)}, {});
  ASSERT_EQ(differs.size(), 1U);
  EXPECT_EQ(differs[0].kind, MapChange::Kind::kDiffers);
}

TEST(MapChanges, FindsNothingInTheSameMineWhereRunsAreOffByTheirErrors) {
  EXPECT_TRUE(find_changes({seen(true), seen(true, 0.15), seen(true, -0.1)}, {}).empty());
}

/// What one run did not see is no evidence.
TEST(MapChanges, FindsNothingWhereOneRunHasNotBeen) {
  std::vector<test::Segment> walls;
  test::add_closed(walls, {{-8, -4}, {-4, -4}, {-4, 4}, {-8, 4}});
  test::LevelLaser laser(test::WallWorld(walls), 1);
  OccupancyGrid west(kGrid);
  for (int i = 0; i < 20; ++i)
    EXPECT_TRUE(west.insert(laser.measure({-6, 0, 0.1 * i}, 1'000'000), {-6, 0, 0.1 * i}));
  const auto changes = find_changes({west, seen(true)}, {});
  for (const MapChange& change : changes) EXPECT_LT(change.p_map.x(), -3.0);
}

TEST(MapChanges, NeedsTwoRuns) { EXPECT_TRUE(find_changes({seen(true)}, {}).empty()); }

}  // namespace
}  // namespace adit
