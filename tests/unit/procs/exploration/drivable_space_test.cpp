// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/drivable_space.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kCellM = 0.2;
constexpr double kWidthM = 1.2;

/// A drift of 20 m along x and 4 m wide, with walls, of which the middle was driven as far as said.
CellField<Known> drift(double driven_m) {
  CellField<Known> known(CellBox{{-1, -11}, {101, 11}}, Known::kWall);
  for (int y = -10; y < 10; ++y) {
    for (int x = 0; x < 100; ++x) {
      const bool driven = std::abs(y) < 2 && kCellM * x < driven_m;
      known[known.index({x, y})] = driven ? Known::kDriven : Known::kFree;
    }
  }
  return known;
}

Access beyond(double driven_m, bool spares_driven) {
  const Cut across{{10.0, 0.0}, {1.0, 0.0}, spares_driven};
  const DrivableSpace space =
      drivable_space(drift(driven_m), kCellM, kWidthM, {across}, {2.0, 0.0}, DrivableParams{});
  return space.access.get(space.cell_at({15.0, 0.0}));
}

TEST(DrivableSpace, EndsAtACut) {
  EXPECT_EQ(beyond(0.0, false), Access::kBehindBarrier);
  EXPECT_EQ(beyond(20.0, false), Access::kBehindBarrier);
}

TEST(DrivableSpace, GoesOnThroughACutThatSparesWhatWasDriven) {
  EXPECT_EQ(beyond(20.0, true), Access::kReachable);
  EXPECT_EQ(beyond(5.0, true), Access::kBehindBarrier);
}

}  // namespace
}  // namespace adit
