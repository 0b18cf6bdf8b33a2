// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_mine.hpp"

#include <set>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/unit/sim/world/passage.hpp"

namespace adit {
namespace {

const std::vector<std::string> kTopologies{"parallel_entries", "room_and_pillar", "branching",
                                           "ring"};

TEST(RandomMine, DependsOnItsSeed) {
  std::set<std::string> all;
  for (int seed = 0; seed < 20; ++seed) {
    const std::string text = to_world_file(random_mine(seed));
    EXPECT_EQ(to_world_file(random_mine(seed)), text);
    all.insert(text);
  }
  EXPECT_EQ(all.size(), 20U);
}

TEST(RandomMine, BuildsWithAboutTheRequestedLength) {
  for (int seed = 0; seed < 50; ++seed) {
    for (const double requested_m : {60.0, 150.0, 300.0}) {
      const RandomMineParams params{.length_m = requested_m, .damage = 0.02 * seed};
      const World world = build_world(random_mine(seed, params));
      EXPECT_NEAR(world.truth.tunnels.length_m(), requested_m, 0.4 * requested_m) << seed;
    }
  }
}

TEST(RandomMine, HasAboutTheRequestedLengthInEachTopology) {
  for (const std::string& topology : kTopologies) {
    for (int seed = 0; seed < 50; ++seed) {
      for (const double requested_m : {30.0, 110.0, 130.0, 400.0, 1500.0, 5000.0}) {
        const WorldDescription mine = random_mine(seed, {topology, requested_m, 0.0});
        double length_m = 0.0;
        for (const TunnelLine& tunnel : tunnel_lines(mine.plan)) {
          length_m += tunnel.length_m();
          EXPECT_GE(tunnel.width_m, 2.5);
          EXPECT_LE(tunnel.width_m, 6.0);
        }
        EXPECT_NEAR(length_m, requested_m, 0.4 * requested_m) << topology << " " << seed;
      }
    }
  }
}

TEST(RandomMine, HasAnUndamagedTunnelBehindItsEntrance) {
  for (int seed = 0; seed < 50; ++seed) {
    const WorldDescription mine = random_mine(seed, {.damage = 1.0});
    const Site site(build_world(mine));
    const TunnelLine main = tunnel_lines(mine.plan).front();
    EXPECT_TRUE(main.entrance);
    EXPECT_EQ(main.name, "main");
    EXPECT_TRUE(is_free(site, {}, mine.T_world_start)) << seed;
    EXPECT_TRUE(is_passable(site, {}, main, 1.5, 20.0)) << seed;
    EXPECT_TRUE(
        is_passable(site, {.length_m = 0.4, .width_m = 2.0, .height_m = 1.4}, main, 1.5, 20.0))
        << seed;
  }
}

TEST(RandomMine, HasTheRequestedDamage) {
  const auto obstacles = [](double damage) {
    std::size_t count = 0;
    for (int seed = 0; seed < 20; ++seed) {
      const PropDescriptions props = random_mine(seed, {.damage = damage}).props;
      count += props.rubble.size() + props.cribs.size() + props.low_roofs.size() +
               props.pits.size() + props.water.size() + props.mud.size() + props.beams.size() +
               props.cars.size();
    }
    return count;
  };
  EXPECT_EQ(obstacles(0.0), 0U);
  EXPECT_GT(obstacles(0.3), 0U);
  EXPECT_GT(obstacles(1.0), 2U * obstacles(0.3));
}

TEST(RandomMine, RejectsAnUnknownTopology) {
  EXPECT_THROW(random_mine(1, {.topology = "spiral"}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
