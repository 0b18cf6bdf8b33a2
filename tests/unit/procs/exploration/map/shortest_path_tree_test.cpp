// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/shortest_path_tree.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kFineM = 0.25;  // exact in binary, so that lengths are exact too

/// A free room of 40 m by `room_m`, with a rim of wall.
class ShortestPathTreeInARoom : public testing::Test {
 protected:
  void make(double room_m) {
    const Eigen::Vector2i size(cells(40.0), cells(room_m));
    const CellBox box{{-1, -1}, size + Eigen::Vector2i::Ones()};
    space_.resolution_m = kFineM;
    space_.known = Grid2<Occupancy>(box, Occupancy::kFree);
    space_.clearance_m = Grid2<float>(box, 5.0F);
    space_.access = Grid2<Access>(box, Access::kNone);
    space_.obstructed = Grid2<std::uint8_t>(box);
    for (int y = 0; y < size.y(); ++y) {
      for (int x = 0; x < size.x(); ++x) space_.access[at(x, y)] = Access::kReachable;
    }
  }
  /// Across the room, 1 m wide, but for `gap_m` at the far side.
  void lay_rail(double room_m, double gap_m) {
    for (int y = 0; y < cells(room_m - gap_m); ++y) {
      for (int x = cells(20.0); x < cells(21.0); ++x) space_.obstructed[at(x, y)] = 1;
    }
  }
  /// Up from the first point, along the other side, and down to the second.
  void drive_around(double room_m) {
    const int top = cells(room_m) - 1;
    for (int y = 0; y <= top; ++y) {
      space_.known[at(0, y)] = Occupancy::kDriven;
      space_.known[at(cells(40.0) - 1, y)] = Occupancy::kDriven;
    }
    for (int x = 0; x < cells(40.0); ++x) space_.known[at(x, top)] = Occupancy::kDriven;
  }
  [[nodiscard]] double path_length_m(PathPreference preference) const {
    const ShortestPathTree field(space_, centre_of({0, 0}, kFineM), preference);
    return field.distance_m(centre_of({cells(40.0) - 1, 0}, kFineM)).value_or(-1.0);
  }
  static int cells(double m) { return static_cast<int>(m / kFineM); }
  [[nodiscard]] std::size_t at(int x, int y) const { return space_.known.index({x, y}); }

  static constexpr double kAcrossM = 40.0 - kFineM;  // from centre to centre
  DrivableSpace space_;
};

TEST_F(ShortestPathTreeInARoom, IsCrossedOnAStraightLine) {
  make(10.0);
  EXPECT_NEAR(path_length_m(PathPreference::kAnyDrivable), kAcrossM, 1e-3);
  EXPECT_NEAR(path_length_m(PathPreference::kDriven), kAcrossM, 1e-3);
}

/// 59.5 m of driven cells instead of 39.75 m of others.
TEST_F(ShortestPathTreeInARoom, IsBypassedOverDrivenCells) {
  make(10.0);
  drive_around(10.0);
  EXPECT_NEAR(path_length_m(PathPreference::kAnyDrivable), kAcrossM, 1.0);
  EXPECT_NEAR(path_length_m(PathPreference::kDriven), kAcrossM + 2.0 * (10.0 - kFineM),
              1.0);  // corners are rounded
}

/// 119.5 m of driven cells are too long a detour.
TEST_F(ShortestPathTreeInARoom, IsCrossedIfTheDetourIsTooLong) {
  make(40.0);
  drive_around(40.0);
  EXPECT_NEAR(path_length_m(PathPreference::kDriven), kAcrossM, 1.0);
}

TEST_F(ShortestPathTreeInARoom, IsCrossedBesideAnObstacle) {
  make(10.0);
  lay_rail(10.0, 2.0);
  // Up and down 8 m on diagonals, which is longer by less than these 16 m.
  EXPECT_NEAR(path_length_m(PathPreference::kAnyDrivable), kAcrossM + 16.0 * (std::sqrt(2.0) - 1.0),
              0.5);
}

TEST_F(ShortestPathTreeInARoom, IsCrossedOverAnObstacleWithoutAnotherPath) {
  make(10.0);
  lay_rail(10.0, 0.0);
  EXPECT_NEAR(path_length_m(PathPreference::kAnyDrivable), kAcrossM, 1e-3);
  EXPECT_NEAR(path_length_m(PathPreference::kDriven), kAcrossM, 1e-3);
}

TEST_F(ShortestPathTreeInARoom, IsCrossedOverAnObstacleWhereTheVehicleHasDriven) {
  make(10.0);
  lay_rail(10.0, 2.0);
  for (int x = 0; x < cells(40.0); ++x) space_.known[at(x, 0)] = Occupancy::kDriven;
  EXPECT_NEAR(path_length_m(PathPreference::kAnyDrivable), kAcrossM, 1e-3);
}

}  // namespace
}  // namespace adit
