// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_mine.hpp"

#include <cstdint>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "sim/vehicle/stance.hpp"
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

/// FNV-1a.
std::uint64_t hash_of(const std::string& text, std::uint64_t hash) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211U;
  }
  return hash;
}

/// A world file without the keys that were added with slopes, all at their defaults in
/// level mines.
std::string without_new_keys(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  int skip = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string key = line.substr(line.find_first_not_of(' '));
    if (key.starts_with("rolls:")) skip = 5;
    if (key == "rise_m: []" || key.starts_with("level: 0 ") || key.starts_with("start_level: 0 ") ||
        key.starts_with("rise_grade: \"smooth\""))
      skip = 1;
    if (skip > 0) {
      --skip;
    } else {
      kept += line + "\n";
    }
  }
  return kept;
}

TEST(RandomMine, LevelMinesAreThoseOfTheFirstResults) {
  std::uint64_t hash = 14695981039346656037U;
  for (int seed = 0; seed < 60; ++seed) {
    for (const double length_m : {60.0, 300.0, 1500.0}) {
      const WorldDescription mine = random_mine(seed, {"any", length_m, 0.02 * seed, true});
      hash = hash_of(without_new_keys(to_world_file(mine)), hash);
    }
  }
  EXPECT_EQ(hash, 0x1310d43065ec0f2bU);  // computed before slopes were added
}

/// Greatest grades of the bare floor along the tunnels over a wheelbase, and across them.
struct Slopes {
  double along = 0.0;
  double across = 0.0;
  double relief_m = 0.0;  ///< from the lowest to the highest place of a floor
  std::size_t steps = 0;
  std::size_t climbable = 0;  ///< of the steps, below 0.36
};

Slopes slopes_of(const WorldDescription& mine) {
  constexpr double kWheelbase = 1.5;
  WorldDescription coarse = mine;
  coarse.grid_m = 1.0;  // only the truth is used
  const World world = build_world(coarse);
  Slopes slopes;
  double low_m = 0.0;
  double high_m = 0.0;
  for (const TunnelLine& tunnel : tunnel_lines(mine.plan)) {
    const auto floor = [&](double s_m, double across_m) {
      return world.truth.floor_at(tunnel.beside(s_m, across_m));
    };
    for (double s_m = kWheelbase; s_m < tunnel.length_m() - kWheelbase; s_m += 0.5) {
      const auto rear = floor(s_m - kWheelbase / 2.0, 0.0);
      const auto front = floor(s_m + kWheelbase / 2.0, 0.0);
      const auto left = floor(s_m, 0.5);
      const auto right = floor(s_m, -0.5);
      if (!rear || !front || !left || !right) continue;
      const double along = std::abs(*front - *rear) / kWheelbase;
      slopes.along = std::max(slopes.along, along);
      slopes.across = std::max(slopes.across, std::abs(*left - *right));
      low_m = std::min(low_m, *rear);
      high_m = std::max(high_m, *rear);
      ++slopes.steps;
      if (along < 0.36) ++slopes.climbable;
    }
  }
  slopes.relief_m = high_m - low_m;
  return slopes;
}

TEST(RandomMine, HasSlopesOfAllKinds) {
  int steep = 0;
  int too_steep = 0;
  int across = 0;
  int rough = 0;
  int high = 0;
  std::size_t steps = 0;
  std::size_t climbable = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const WorldDescription mine = random_mine(seed);
    const Slopes slopes = slopes_of(mine);
    steep += slopes.along > 0.2 ? 1 : 0;
    too_steep += slopes.along > 0.40 ? 1 : 0;
    across += slopes.across > 0.12 ? 1 : 0;
    rough += mine.heights.floor_relief.height_m > 0.05 ? 1 : 0;
    high += slopes.relief_m > 5.0 ? 1 : 0;
    steps += slopes.steps;
    climbable += slopes.climbable;
  }
  EXPECT_GT(steep, 30);
  EXPECT_GT(across, 30);
  EXPECT_GT(rough, 20);
  EXPECT_GT(high, 25);
  EXPECT_GT(too_steep, 5);
  EXPECT_LT(too_steep, 30);
  EXPECT_GT(static_cast<double>(climbable), 0.99 * static_cast<double>(steps));
}

TEST(RandomMine, LongMinesHaveTensOfMetresOfRelief) {
  int high = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Slopes slopes = slopes_of(random_mine(seed, {.length_m = 3000.0}));
    EXPECT_LT(slopes.relief_m, 70.0) << seed;  // ± 25 m of the seam, and ramps
    high += slopes.relief_m > 10.0 ? 1 : 0;
  }
  EXPECT_GT(high, 10);
}

TEST(RandomMine, HasThePlanOfTheLevelOne) {
  for (int seed = 0; seed < 20; ++seed) {
    WorldDescription uneven = random_mine(seed);
    for (TunnelDescription& tunnel : uneven.plan.tunnels) tunnel.rise_m.clear();
    for (TunnelDescription& tunnel : uneven.plan.tunnels) tunnel.rise_grade = "smooth";
    const WorldDescription level = random_mine(seed, {.level = true});
    WorldDescription expected = level;
    expected.name = uneven.name;
    expected.heights = uneven.heights;
    expected.props = uneven.props;
    EXPECT_EQ(to_world_file(uneven), to_world_file(expected));
    EXPECT_LE(uneven.props.posts.size(), level.props.posts.size());
  }
}

TEST(RandomMine, IsClimbedByTheVehicleWhereItIsNotTooSteep) {
  int driven = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const WorldDescription mine = random_mine(seed, {.damage = 0.0});
    if (slopes_of(mine).along > 0.36) continue;
    WorldDescription bare = mine;
    bare.props = {};
    const Site site(build_world(bare));
    const TunnelLine main = tunnel_lines(mine.plan).front();
    Stance stance(site, {});
    const Pose2& start = mine.T_world_start;
    ASSERT_EQ(stance.put(start, site.world().truth.floor_at(start.translation()).value()),
              std::nullopt);
    for (double s_m = start.x; s_m < main.length_m() - 1.5; s_m += 0.05) {
      const TunnelLine::Station at = main.at(s_m);
      // Turns at once at a bend: the change of height is that of the wheels, not of the body.
      const auto fault = stance.move({at.p_world.x(), at.p_world.y(), at.heading_rad});
      ASSERT_EQ(fault, std::nullopt) << "seed " << seed << " at " << s_m;
    }
    ++driven;
  }
  EXPECT_GT(driven, 20);
}

TEST(RandomMine, RejectsAnUnknownTopology) {
  EXPECT_THROW(random_mine(1, {.topology = "spiral"}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
