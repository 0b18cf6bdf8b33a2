// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/scanned_ground.hpp"

#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kScannedM = 0.2;  // side of a cell
/// 1 m high, climbs 0.2 m.
const Vehicle kVehicle;

/// 6 m by 4 m of observed, level ground under a roof at 2 m; cells of 0.1 m.
class ScannedCells : public testing::Test {
 protected:
  ScannedCells() {
    terrain_.p_level_corner = {-3.0, -2.0};
    terrain_.cell_m = 0.1;
    TerrainCell ground;
    ground.ground = Ground::kObserved;
    ground.coefficient_m = 0.05F;
    ground.clearance_m = 2.0F;
    terrain_.cells = Grid2<TerrainCell>(60, 40, ground);
  }

  TerrainCell& terrain_at(double x, double y) {
    return terrain_.cells.at(terrain_.cell_at({x, y}));
  }
  [[nodiscard]] ScannedCell scanned_at(double x, double y) const {
    return scanned_cells(terrain_, kScannedM, kVehicle).get(cell_of({x, y}, kScannedM));
  }
  /// Expects that cells within two cells of 0.2 m around (1.1, 0.1) are not ground, and others are.
  void expect_no_ground_around(ScannedCell middle) const {
    const Grid2<ScannedCell> cells = scanned_cells(terrain_, kScannedM, kVehicle);
    const Eigen::Vector2i at = cell_of({1.1, 0.1}, kScannedM);
    for (int y = -3; y <= 3; ++y) {
      for (int x = -3; x <= 3; ++x) {
        const bool near = std::abs(x) <= 2 && std::abs(y) <= 2;
        const auto expected = x == 0 && y == 0 ? middle
                              : near           ? ScannedCell::kUnknown
                                               : ScannedCell::kGround;
        EXPECT_EQ(cells.get(at + Eigen::Vector2i(x, y)), expected) << x << ", " << y;
      }
    }
  }

  TerrainMap terrain_;
};

TEST_F(ScannedCells, AreGroundOnlyInsideObservedGround) {
  const Grid2<ScannedCell> cells = scanned_cells(terrain_, kScannedM, kVehicle);
  int ground = 0;
  for (const ScannedCell cell : cells) {
    EXPECT_NE(cell, ScannedCell::kRock);
    ground += cell == ScannedCell::kGround ? 1 : 0;
  }
  EXPECT_EQ(ground, (30 - 4) * (20 - 4));  // two cells from the rim
  EXPECT_EQ(scanned_at(0.0, 0.0), ScannedCell::kGround);
  EXPECT_EQ(scanned_at(2.5, 0.0), ScannedCell::kGround);
  EXPECT_EQ(scanned_at(2.7, 0.0), ScannedCell::kUnknown);
}

TEST_F(ScannedCells, AreNotGroundNearCellsThatWereNotObserved) {
  for (const Ground ground :
       {Ground::kNeverObserved, Ground::kOccluded, Ground::kBelowRay, Ground::kNoReturn}) {
    terrain_at(1.15, 0.15).ground = ground;
    expect_no_ground_around(ScannedCell::kUnknown);
  }
}

TEST_F(ScannedCells, AreRockAboveTheHeightOfObstacles) {
  terrain_at(1.15, 0.15).coefficient_m = 0.7F;
  expect_no_ground_around(ScannedCell::kRock);
  terrain_at(1.15, 0.15).coefficient_m = 0.4F;  // an obstacle may be a step
  expect_no_ground_around(ScannedCell::kObstacle);
  terrain_at(1.15, 0.15).coefficient_m = 0.2F;  // a stone to drive over
  EXPECT_EQ(scanned_at(1.1, 0.1), ScannedCell::kGround);
}

/// A rail: ground is beside it, and a vehicle with larger wheels drives over it.
TEST_F(ScannedCells, AreObstaclesWhereTheVehicleCannotDriveOverThem) {
  terrain_at(1.15, 0.15).coefficient_m = 0.12F;
  EXPECT_EQ(scanned_at(1.1, 0.1), ScannedCell::kGround);
  for (const bool by_step : {true, false}) {
    Vehicle small;
    (by_step ? small.step_max_m : small.belly_clearance_m) = 0.1;
    const Grid2<ScannedCell> cells = scanned_cells(terrain_, kScannedM, small);
    EXPECT_EQ(cells.get(cell_of({1.1, 0.1}, kScannedM)), ScannedCell::kObstacle);
    EXPECT_EQ(cells.get(cell_of({1.3, 0.1}, kScannedM)), ScannedCell::kGround);
  }
  terrain_at(1.15, 0.15).ground = Ground::kNeverObserved;
  EXPECT_EQ(scanned_at(1.1, 0.1), ScannedCell::kUnknown);
}

TEST_F(ScannedCells, AreNotGroundUnderALowRoof) {
  terrain_at(1.15, 0.15).clearance_m = 0.9F;
  expect_no_ground_around(ScannedCell::kUnknown);
  terrain_at(1.15, 0.15).clearance_m = std::numeric_limits<float>::quiet_NaN();
  expect_no_ground_around(ScannedCell::kUnknown);
  terrain_at(1.15, 0.15).clearance_m = std::numeric_limits<float>::infinity();  // no roof
  EXPECT_EQ(scanned_at(1.1, 0.1), ScannedCell::kGround);
}

TEST_F(ScannedCells, CoverACornerBetweenCells) {
  terrain_.p_level_corner = {-2.93, -2.07};
  for (TerrainCell& cell : terrain_.cells) cell.coefficient_m = 1.5F;
  const Grid2<ScannedCell> cells = scanned_cells(terrain_, kScannedM, kVehicle);
  EXPECT_TRUE(cells.contains(cell_of(terrain_.centre(0, 0), kScannedM)));
  EXPECT_TRUE(cells.contains(cell_of(terrain_.centre(59, 39), kScannedM)));
  EXPECT_EQ(cells.get(cell_of(terrain_.centre(59, 39), kScannedM)), ScannedCell::kRock);
}

TEST_F(ScannedCells, OfAnEmptyTerrainAreUnknown) {
  for (const ScannedCell cell : scanned_cells(TerrainMap{}, kScannedM, kVehicle)) {
    EXPECT_EQ(cell, ScannedCell::kUnknown);
  }
}

ScannedGround example() {
  ScannedGround ground{7, {1.0 / 3.0, -0.1, 2.5}, Grid2<ScannedCell>(CellBox{{-3, -2}, {1, 4}})};
  ground.cells.at({-3, -2}) = ScannedCell::kGround;
  ground.cells.at({0, 3}) = ScannedCell::kRock;
  ground.cells.at({0, 2}) = ScannedCell::kObstacle;
  return ground;
}

TEST(ScannedGroundText, SurvivesARoundTrip) {
  const auto read = scanned_ground_from_text(to_text(example()));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, example());
  EXPECT_EQ(to_text(*read), to_text(example()));
}

TEST(ScannedGroundText, IsRejectedIfMalformed) {
  const std::string valid = "7 0.5 -0.25 2.5 -1 -1 1 1 0120\n";
  ASSERT_TRUE(scanned_ground_from_text(valid));
  for (const char* text : {
           "",
           "\n",
           "7 0.5 -0.25 2.5 -1 -1 1 1\n",
           "7 0.5 -0.25 2.5 -1 -1 1 1 012\n",    // too few cells
           "7 0.5 -0.25 2.5 -1 -1 1 1 01200\n",  // too many
           "7 0.5 -0.25 2.5 -1 -1 1 1 0140\n",   // unknown class
           "7 0.5 -0.25 2.5 -1 -1 1 1 01/0\n",   // the character before 0
           "-1 0.5 -0.25 2.5 -1 -1 1 1 0120\n",  // no local map
           "7 nan -0.25 2.5 -1 -1 1 1 0120\n",   //
           "7 0.5 1e999 2.5 -1 -1 1 1 0120\n",   //
           "7 0.5 -0.25 2.5 1 1 -1 -1 0120\n",   // empty box
           "7 0.5 -0.25 2.5 0 0 0 0 \n",         //
           "7 0.5 -0.25 2.5 0 0 2000000 1 0\n",  // too large
           "7 0.5 -0.25 2.5 0 0 99999999999 1 0\n",
           "seven 0.5 -0.25 2.5 -1 -1 1 1 0120\n",
       }) {
    EXPECT_FALSE(scanned_ground_from_text(text)) << text;
  }
}

}  // namespace
}  // namespace adit
