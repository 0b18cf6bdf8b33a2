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

}  // namespace
}  // namespace adit
