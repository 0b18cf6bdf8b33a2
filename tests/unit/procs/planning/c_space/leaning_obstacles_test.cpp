// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/leaning_obstacles.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "procs/planning/c_space/ground_layers.hpp"

namespace adit {
namespace {

/// Ground with a grade, and a plumb wall along x whose face is the plane y = `wall_y_m`.
TerrainMap corridor(const Eigen::Vector2d& grade, double wall_y_m, double wall_height_m) {
  TerrainMap terrain;
  terrain.cell_m = 0.1;
  terrain.p_level_corner = {-4.0, -4.0};
  terrain.cells = Grid2<TerrainCell>(80, 80);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 80; ++column) {
      TerrainCell& cell = terrain.cells.at({column, row});
      const Eigen::Vector2d p = terrain.centre(column, row);
      cell.ground = Ground::kObserved;
      cell.count = 9;
      cell.low_m = static_cast<float>(grade.dot(p));
      cell.coefficient_m = p.y() < wall_y_m ? static_cast<float>(wall_height_m) : 0.0F;
      cell.high_m = cell.low_m + cell.coefficient_m;
      cell.clearance_m = 3.0F;
    }
  }
  return terrain;
}

/// The distance from the wall to the nearest place beside it that is free for the body.
double blocked_beside_m(const TerrainMap& terrain, double wall_y_m) {
  const GroundLayers layers = ground_layers(terrain, {0.0, 3.0, 0.0}, {}, {});
  double y = wall_y_m;
  while (layers.under_body.at(terrain.cell_at({0.05, y + 0.05})) != 0) y += 0.1;
  return y - wall_y_m;
}

TEST(LeaningObstacles, StandUprightOnLevelGround) {
  const TerrainMap terrain = corridor({0.0, 0.0}, -1.0, 1.0);
  EXPECT_EQ(LeaningObstacles(terrain).displacement_m(40, 30, 1.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR(blocked_beside_m(terrain, -1.0), 0.0, 1e-9);
}

/// The foot of the perpendicular: at a right angle to the ground, and plumb above the cell.
TEST(LeaningObstacles, StandAtTheFootOfThePerpendicular) {
  const Eigen::Vector2d grade(0.1, 0.2);
  const TerrainMap terrain = corridor(grade, -9.0, 1.0);
  const Eigen::Vector2d moved = LeaningObstacles(terrain).displacement_m(40, 40, 1.0);
  const Eigen::Vector3d up(moved.x(), moved.y(), grade.dot(moved) - 1.0);  // from the point
  EXPECT_NEAR(up.dot(Eigen::Vector3d(1.0, 0.0, grade.x())), 0.0, 1e-3);
  EXPECT_NEAR(up.dot(Eigen::Vector3d(0.0, 1.0, grade.y())), 0.0, 1e-3);
}

/// On a cross slope the body leans to the wall on the low side, not to that on the high side.
TEST(LeaningObstacles, LeanOverTheGroundOnTheLowSide) {
  const double grade = 0.25;
  EXPECT_NEAR(blocked_beside_m(corridor({0.0, grade}, -1.0, 1.0), -1.0),
              grade / (1.0 + grade * grade), 0.1);
  EXPECT_NEAR(blocked_beside_m(corridor({0.0, -grade}, -1.0, 1.0), -1.0), 0.0, 1e-9);
}

TEST(LeaningObstacles, ALowObstacleLeansLess) {
  EXPECT_NEAR(blocked_beside_m(corridor({0.0, 0.25}, -1.0, 0.4), -1.0), 0.1, 0.1);
}

}  // namespace
}  // namespace adit
