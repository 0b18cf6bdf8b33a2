// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/drivable_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kCellM = 0.2;
constexpr double kWidthM = 1.2;

/// A tunnel of 20 m along x and 4 m wide, with walls, whose centre line is driven up to a given x.
Grid2<Occupancy> tunnel(double driven_m) {
  Grid2<Occupancy> known(CellBox{{-1, -11}, {101, 11}}, Occupancy::kWall);
  for (int y = -10; y < 10; ++y) {
    for (int x = 0; x < 100; ++x) {
      const bool driven = std::abs(y) < 2 && kCellM * x < driven_m;
      known[known.index({x, y})] = driven ? Occupancy::kDriven : Occupancy::kFree;
    }
  }
  return known;
}

Access beyond(double driven_m, bool passable_where_driven) {
  const BarrierLine across{{10.0, 0.0}, {1.0, 0.0}, passable_where_driven};
  const DrivableSpace space =
      drivable_space(tunnel(driven_m), {}, kCellM, kWidthM, {across}, {2.0, 0.0}, DrivableParams{});
  return space.access.get(space.cell_at({15.0, 0.0}));
}

TEST(DrivableSpace, EndsAtABarrier) {
  EXPECT_EQ(beyond(0.0, false), Access::kBehindBarrier);
  EXPECT_EQ(beyond(20.0, false), Access::kBehindBarrier);
}

TEST(DrivableSpace, ContinuesThroughABarrierThatIsPassableWhereDriven) {
  EXPECT_EQ(beyond(20.0, true), Access::kReachable);
  EXPECT_EQ(beyond(5.0, true), Access::kBehindBarrier);
}

/// A rail along the tunnel, 0.1 m left of its centre line.
TEST(DrivableSpace, IsObstructedWithinTheRadiusOfTheVehicleAroundALowObstacle) {
  const double driven_m = 5.0;
  const Grid2<Occupancy> known = tunnel(driven_m);
  Grid2<std::uint8_t> rail(known.box());
  for (int x = 0; x < 100; ++x) rail[rail.index({x, 0})] = 1;
  const DrivableSpace space =
      drivable_space(known, rail, kCellM, kWidthM, {}, {2.0, 0.0}, DrivableParams{});
  for (std::size_t i = 0; i < space.known.size(); ++i) {
    const double from_rail_m = std::abs(space.middle(i).y() - kCellM / 2.0);
    const double before_m = std::max(-space.middle(i).x(), space.middle(i).x() - 20.0);
    if (before_m > 0.0) continue;  // beyond the ends of the rail
    const bool expected = from_rail_m < space.radius_m && known[i] != Occupancy::kDriven;
    EXPECT_EQ(space.obstructed[i] != 0, expected) << space.middle(i).transpose();
  }
  EXPECT_EQ(space.access.get(space.cell_at({15.0, 0.0})), Access::kReachable);
}

}  // namespace
}  // namespace adit
