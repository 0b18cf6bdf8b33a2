// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/world_choice.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

WorldChoice random_mine_of(int seed) {
  WorldChoice choice;
  choice.name = "random";
  choice.seed = seed;
  return choice;
}

TEST(WorldChoice, PutsAVehicleThatRailsWouldHoldBesideThem) {
  Vehicle small;
  small.width_m = 0.66;
  small.step_max_m = 0.1;
  int beside = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const WorldDescription plain = describe(random_mine_of(seed));
    const WorldDescription world = describe(random_mine_of(seed), small);
    const bool has_rails = !plain.props.rails.empty();
    const double across_m = world.T_world_start.y;  // the first tunnel leads along x
    if (!has_rails || across_m == 0.0) {
      EXPECT_EQ(world.T_world_start, plain.T_world_start) << seed;
      continue;
    }
    ++beside;
    const double rail_m = 0.5 * plain.props.rails.front().gauge_m + 0.1;
    EXPECT_GT(across_m - 0.5 * small.width_m, rail_m) << seed;
  }
  EXPECT_GE(beside, 3);
}

TEST(WorldChoice, LeavesAVehicleThatClimbsRailsWhereItIs) {
  for (int seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(describe(random_mine_of(seed), Vehicle{}).T_world_start,
              describe(random_mine_of(seed)).T_world_start);
  }
}

}  // namespace
}  // namespace adit
