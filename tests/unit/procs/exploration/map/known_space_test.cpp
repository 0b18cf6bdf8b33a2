// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/known_space.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

/// A body drove 4 m along x and observed a strip of 1 m to each side.
LocalMapTile strip() {
  LocalMapTile tile;
  for (int y = -5; y < 5; ++y) {
    for (int x = 0; x < 20; ++x) tile.free.emplace_back(x, y);
  }
  tile.path = {{0.1, 0.1}, {3.9, 0.1}};
  return tile;
}

Occupancy between_tiles_at(double gap_m) {
  KnownSpace space{KnownSpaceParams{}};
  space.add(0, strip());
  space.add(1, strip());
  space.pose({{}, {4.0 + gap_m, 0.0, 0.0}});
  return space.cells().get(cell_of({4.0 + gap_m / 2.0, 0.1}, space.resolution_m()));
}

TEST(KnownSpace, ConnectsThePathAcrossASeamOfLocalMaps) {
  EXPECT_EQ(between_tiles_at(1.0), Occupancy::kDriven);
}

/// As where mapping stored no local maps in between: there may be rock.
TEST(KnownSpace, DoesNotMarkTheGapBetweenDistantLocalMapsAsDriven) {
  EXPECT_EQ(between_tiles_at(10.0), Occupancy::kUnseen);
}

/// The strip with returns at its end, x = 4.1 m, all across.
LocalMapTile strip_with_end(bool steep = false) {
  LocalMapTile tile = strip();
  for (int y = -5; y < 5; ++y) tile.walls.push_back({{4.1, 0.2 * (y + 0.5)}, steep});
  return tile;
}

/// A 3D scan at the origin of a local map, that observed this in 1 m by 1 m around a place.
ScannedGround scan_of(ScannedCell cell, const Eigen::Vector2d& p_local, int local_map = 0) {
  const Eigen::Vector2i middle = cell_of(p_local, 0.2);
  const Eigen::Vector2i reach(2, 2);
  return {local_map,
          {},
          Grid2<ScannedCell>({middle - reach, middle + reach + Eigen::Vector2i(1, 1)}, cell)};
}

class EndOfAStrip : public testing::Test {
 protected:
  EndOfAStrip() {
    space_.add(0, strip_with_end());
    space_.pose({{}});
  }
  [[nodiscard]] Occupancy at(const Eigen::Vector2d& p_map, Walls walls = Walls::kAll) const {
    return space_.cells(walls).get(cell_of(p_map, space_.resolution_m()));
  }

  KnownSpace space_{KnownSpaceParams{}};
  const Eigen::Vector2d p_end_{4.1, 0.7};  // beside the path, which is driven
};

TEST_F(EndOfAStrip, IsAWallWithout3DScans) {
  EXPECT_EQ(at(p_end_), Occupancy::kWall);
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kWall);
}

TEST_F(EndOfAStrip, IsFreeInsideObservedGround) {
  space_.add(scan_of(ScannedCell::kGround, p_end_));
  EXPECT_EQ(at(p_end_), Occupancy::kFree);
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kFree);
  EXPECT_EQ(at({4.1, -0.9}), Occupancy::kWall);  // beyond the observed ground
  space_.clear_scanned_ground();
  EXPECT_EQ(at(p_end_), Occupancy::kWall);
  EXPECT_TRUE(space_.scanned_ground().empty());
}

TEST_F(EndOfAStrip, HasALowObstacleWhereMore3DScansShowItThanGround) {
  const Eigen::Vector2d p(2.1, 0.7);
  const auto is_obstacle = [&] {
    return space_.low_obstacles().get(cell_of(p, space_.resolution_m())) != 0;
  };
  EXPECT_FALSE(is_obstacle());
  EXPECT_EQ(space_.low_obstacles().box(), space_.cells().box());
  space_.add(scan_of(ScannedCell::kObstacle, p));
  EXPECT_TRUE(is_obstacle());
  EXPECT_EQ(at(p), Occupancy::kFree);
  space_.add(scan_of(ScannedCell::kGround, p));
  EXPECT_FALSE(is_obstacle());
  space_.clear_scanned_ground();
  space_.add(scan_of(ScannedCell::kObstacle, p));
  space_.pose({{0.0, 3.0, 0.0}});  // it moves with its local map
  EXPECT_FALSE(is_obstacle());
}

TEST_F(EndOfAStrip, IsAWallWhereAny3DScanObservedRock) {
  space_.add(scan_of(ScannedCell::kGround, p_end_));
  space_.add(scan_of(ScannedCell::kRock, p_end_));
  EXPECT_EQ(at(p_end_), Occupancy::kWall);
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kWall);
}

TEST_F(EndOfAStrip, IsUnseenUntilA3DScanConfirmsIt) {
  space_.add(scan_of(ScannedCell::kGround, {1.0, 0.1}));  // elsewhere
  EXPECT_EQ(at(p_end_), Occupancy::kWall);
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kUnseen);
  EXPECT_EQ(at({3.0, 0.5}, Walls::kConfirmed), Occupancy::kFree);
  // Rock of which the nearest cells are two cells, 0.4 m, beyond it.
  space_.add(scan_of(ScannedCell::kRock, p_end_ + Eigen::Vector2d(0.8, 0.0)));
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kWall);
}

TEST_F(EndOfAStrip, IsDismissedWhereItIsGroundOrUnconfirmed) {
  const Eigen::Vector2d before = p_end_ - Eigen::Vector2d(0.6, 0.0);  // three cells
  const Eigen::Vector2d far = p_end_ - Eigen::Vector2d(0.8, 0.0);
  for (const Walls walls : {Walls::kAll, Walls::kConfirmed}) {
    EXPECT_FALSE(space_.dismisses_wall_near(before, walls));
  }
  space_.add(scan_of(ScannedCell::kGround, {1.0, 0.1}));  // elsewhere
  EXPECT_FALSE(space_.dismisses_wall_near(before, Walls::kAll));
  EXPECT_TRUE(space_.dismisses_wall_near(before, Walls::kConfirmed));
  EXPECT_FALSE(space_.dismisses_wall_near(far, Walls::kConfirmed));
  space_.add(scan_of(ScannedCell::kGround, p_end_));
  EXPECT_TRUE(space_.dismisses_wall_near(before, Walls::kAll));
}

TEST_F(EndOfAStrip, IsNotConfirmedByRockFartherAway) {
  space_.add(scan_of(ScannedCell::kRock, p_end_ + Eigen::Vector2d(1.0, 0.0)));  // 0.6 m beyond
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kUnseen);
}

TEST_F(EndOfAStrip, IsAWallIfSteep) {
  space_.add(0, strip_with_end(true));
  space_.pose({{}});
  space_.add(scan_of(ScannedCell::kGround, {1.0, 0.1}));
  EXPECT_EQ(at(p_end_, Walls::kConfirmed), Occupancy::kWall);
}

TEST_F(EndOfAStrip, KeepsItsGroundWhenTheGraphMoves) {
  space_.add(scan_of(ScannedCell::kGround, p_end_));
  const Pose2 T{30.0, -3.0, 1.0};
  space_.pose({T});
  EXPECT_EQ(at(T * p_end_), Occupancy::kFree);
  // A wall of another local map where the ground was before is no ground.
  space_.add(1, strip_with_end());
  space_.pose({T, {}});
  EXPECT_EQ(at(T * p_end_), Occupancy::kFree);
  EXPECT_EQ(at(p_end_), Occupancy::kWall);
  space_.pose({{}, T});  // exchanged
  EXPECT_EQ(at(p_end_), Occupancy::kFree);
  EXPECT_EQ(at(T * p_end_), Occupancy::kWall);
}

TEST(KnownSpace, LeavesNoHolesInTurnedGround) {
  LocalMapTile returns;
  returns.path = {{0.1, 0.1}};
  for (int y = -20; y < 20; ++y) {
    for (int x = -20; x < 20; ++x) returns.walls.push_back({centre_of({x, y}, 0.2)});
  }
  for (double theta = 0.05; theta < 0.8; theta += 0.05) {
    KnownSpace space{KnownSpaceParams{}};
    space.add(0, {});
    space.add(1, returns);
    space.pose({{0.03, 0.07, theta}, {}});
    space.add({0, {}, Grid2<ScannedCell>({{-20, -20}, {20, 20}}, ScannedCell::kGround)});
    const Grid2<Occupancy> cells = space.cells();
    for (int y = -10; y < 10; ++y) {  // inside, whatever the angle
      for (int x = -10; x < 10; ++x) ASSERT_NE(cells.get({x, y}), Occupancy::kWall) << theta;
    }
  }
}

/// As after a restart, when the journal restores 3D scans before mapping sends the map.
TEST(KnownSpace, PlacesGroundOnceItsLocalMapHasAPose) {
  KnownSpace space{KnownSpaceParams{}};
  const Eigen::Vector2d p_end(4.1, 0.7);
  space.add(scan_of(ScannedCell::kGround, p_end, 1));
  space.add(0, strip_with_end());
  space.pose({{}});
  const auto at = [&](const Eigen::Vector2d& p) {
    return space.cells().get(cell_of(p, space.resolution_m()));
  };
  EXPECT_EQ(at(p_end), Occupancy::kWall);
  space.add(1, strip_with_end());
  space.pose({{}, {10.0, 0.0, 0.0}});
  EXPECT_EQ(at(p_end), Occupancy::kWall);
  EXPECT_EQ(at(p_end + Eigen::Vector2d(10.0, 0.0)), Occupancy::kFree);
  space.pose({{}});  // the local map is no longer in the graph
  EXPECT_EQ(at(p_end + Eigen::Vector2d(10.0, 0.0)), Occupancy::kUnseen);
}

LocalMapTile strip_that_observed(const std::vector<Eigen::Vector3d>& footprint) {
  LocalMapTile tile = strip_with_end();
  tile.footprint = footprint;
  return tile;
}

/// The first two local maps lie above each other, the third continues both. A 3D scan may show
/// ground where it has returns: then the cell is free in each layer, and the border of one layer is
/// no frontier if the other one knows what follows.
TEST(KnownSpace, SharesReturnsBetweenLayersToo) {
  KnownSpace space{KnownSpaceParams{}};
  space.add(0, strip_that_observed({{0.5, 0.5, 0.0}, {5.5, 0.5, 0.0}}));
  space.add(1, strip_that_observed({{0.5, 0.5, -6.0}, {10.5, 0.5, 0.0}}));
  space.add(2, strip_that_observed({{5.5, 0.5, 0.0}, {10.5, 0.5, 0.0}}));
  const std::vector<double> level(3, 0.0);
  space.pose({{}, {}, {}}, level, level);
  ASSERT_EQ(space.poses_of(2).size(), 2U);
  const SharedCells shared = space.shared_cells();
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(3.9, 0.1), Eigen::Vector2d(4.1, 0.1)}) {
    std::vector<int> others;
    shared.for_each(space.cells().index(cell_of(p, space.resolution_m())),
                    [&](std::size_t, int layer) { others.push_back(layer); });
    EXPECT_EQ(others, std::vector<int>{1}) << p.x();
  }
}

}  // namespace
}  // namespace adit
