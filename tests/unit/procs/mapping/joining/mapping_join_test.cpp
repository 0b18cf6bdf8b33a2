// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Mapping::join: maps of walks through simulated mines, against the truth.
#include <algorithm>

#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/random/random_mine.hpp"
#include "tests/support/drives/walked_map.hpp"

namespace adit {
namespace {

constexpr double kErrorM = 0.15;  // of a local map after a walk of 130 m; matches err by 3 mm

using Path = std::vector<Eigen::Vector2d>;

// In the mine `sample`: from the portal around the west of the ring, and from the north-east
// around the east and back.
const Path kFromPortal{{4, 0}, {35, 0}, {30, 18}, {36, 40}, {56, 50}, {36, 40}, {30, 18}, {35, 0}};
const Path kFromEast{{93, 68}, {86, 52}, {56, 50}, {36, 40}, {30, 18}, {35, 0}, {48, -4}, {60, -5}};
const Path kFarEast{{122, 2}, {100, 8}, {104, 34}, {86, 52}};

test::WalkedMap walk(int mine, const Path& path, std::uint64_t seed, double lasers_m = 1.0) {
  return test::walked_map(test::sample_mine(mine), path,
                          {.seed = seed, .lasers = test::lasers_at_ends(lasers_m)});
}

/// Largest error of the pose of a local map of the run relative to the first one of the map.
double largest_error_m(const Mapping& joined, const test::WalkedMap& map,
                       const test::WalkedMap& run, int first_of_run) {
  const std::vector<Pose2> poses = joined.graph().poses;
  const Pose2 T_world_map = map.truth.at(joined.local_maps()[0].utime) * poses[0].inverse();
  double largest_m = 0.0;
  for (std::size_t i = static_cast<std::size_t>(first_of_run); i < poses.size(); ++i) {
    const Pose2 truth = run.truth.at(joined.local_maps()[i].utime);
    largest_m =
        std::max(largest_m, (truth.translation() - (T_world_map * poses[i]).translation()).norm());
  }
  return largest_m;
}

TEST(MappingJoin, JoinsRunsOfTwoRobotsWithDifferentStarts) {
  const test::WalkedMap map = walk(1, kFromPortal, 1);
  const test::WalkedMap run = walk(1, kFromEast, 2, 0.7);
  const std::size_t before = map.map->local_maps().size();
  const RunJoin join = map.map->join(*run.map);
  ASSERT_TRUE(join.joined) << join.reason;
  EXPECT_EQ(join.first_map, static_cast<int>(before));
  EXPECT_EQ(map.map->local_maps().size(), before + run.map->local_maps().size());
  EXPECT_GE(join.places, 3);
  EXPECT_LT(join.contradicting_share(), 0.05);
  for (const JoinLink& link : join.links) {
    const auto utime = [&](int i) {
      return map.map->local_maps()[static_cast<std::size_t>(i)].utime;
    };
    const Pose2 truth = between(map.truth.at(utime(link.older)), run.truth.at(utime(link.newer)));
    EXPECT_LT(between(truth, link.T_older_newer).translation().norm(), kErrorM);
  }
  EXPECT_LT(largest_error_m(*map.map, map, run, join.first_map), kErrorM);
}

TEST(MappingJoin, LeavesTheMapAsItWasIfTheRunWasElsewhere) {
  const test::WalkedMap map = walk(1, kFromPortal, 1);
  const test::WalkedMap run = walk(1, kFarEast, 2);
  const MapGraph before = map.map->graph();
  const RunJoin join = map.map->join(*run.map);
  EXPECT_FALSE(join.joined);
  EXPECT_NE(join.reason, "");
  EXPECT_EQ(map.map->graph().poses, before.poses);
  EXPECT_EQ(map.map->graph().constraints.size(), before.constraints.size());
}

/// A mine with branches, and walls that are rough by some centimetres, by their seed.
test::WalkedMap walk_branches(int walls, int robot) {
  RandomMineParams params;
  params.topology = "branching";
  params.damage = 0.0;
  params.level = true;
  WorldDescription mine = random_mine(22, params);
  mine.seed = walls;
  mine.heights.profile_m = {};
  mine.heights.rolls.height_m = 0.0;
  mine.props = {};
  const World world = build_world(mine);
  return test::walked_map(test::WallWorld(world, 0.6), test::tour(world.truth.tunnels, 0, 400.0),
                          {.seed = static_cast<std::uint64_t>(2200 + robot),
                           .lasers = test::lasers_at_ends(robot == 1 ? 0.7 : 1.05)});
}

/// The plans are equal, the roughness of the walls is not.
TEST(MappingJoin, DoesNotJoinARunOfAnotherMineWithTheSamePlan) {
  const test::WalkedMap map = walk_branches(22, 1);
  const test::WalkedMap same = walk_branches(22, 2);
  const test::WalkedMap other = walk_branches(1022, 50);
  const RunJoin wrong = map.map->join(*other.map);
  EXPECT_FALSE(wrong.joined);
  EXPECT_GE(wrong.places, 3);
  EXPECT_FALSE(wrong.walls_agree);
  EXPECT_GT(wrong.walls_apart_m, 4.0 * wrong.own_apart_m);
  const RunJoin right = map.map->join(*same.map);
  EXPECT_TRUE(right.joined) << right.reason;
  EXPECT_LT(right.walls_apart_m, 1.3 * right.own_apart_m);
}

/// Through what was rejected alone a third run leads.
TEST(MappingJoin, JoinsARunThroughAnother) {
  const test::WalkedMap map = walk(1, kFromPortal, 1);
  const test::WalkedMap run = walk(1, kFromEast, 2);
  const Path all_east{{122, 2}, {100, 8}, {104, 34}, {86, 52}, {56, 50}, {40, 42}};
  const test::WalkedMap far = walk(1, all_east, 3);
  ASSERT_TRUE(map.map->join(*run.map).joined);
  const RunJoin join = map.map->join(*far.map);
  ASSERT_TRUE(join.joined) << join.reason;
  EXPECT_LT(largest_error_m(*map.map, map, far, join.first_map), kErrorM);
}

}  // namespace
}  // namespace adit
