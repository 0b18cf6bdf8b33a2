// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Complete missions in small random mines, scored by ground truth.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "tests/support/scores/mission_log.hpp"
#include "tests/support/scores/mission_score.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/box_tunnel.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

WorldChoice small_mine(int seed, const std::string& topology) {
  WorldChoice choice;
  choice.name = "random_level";
  choice.seed = seed;
  choice.length_m = 30.0;
  choice.topology = topology;
  choice.damage = 0.5;
  return choice;
}

TEST(MissionTruth, ExcludesCorridorsBehindWater) {
  World world = box_tunnel({.length_m = 40.0, .width_m = 2.2, .height_m = 2.0});
  world.truth.tunnels.nodes = {{{-20.0, 0.0}}, {{20.0, 0.0}}};
  world.truth.tunnels.edges = {{0, 1, {{-20.0, 0.0}, {20.0, 0.0}}, 40.0, 2.2, "main"}};
  const double complete_m = test::MissionTruth(world).score({}).corridor_m;
  // Shallow water, but its depth cannot be measured.
  world.truth.obstacles = {{.kind = PartKind::kWater,
                            .name = "water",
                            .outline = {{10.0, -1.1}, {14.0, -1.1}, {14.0, 1.1}, {10.0, 1.1}},
                            .z_low_m = -0.1,
                            .z_high_m = 0.0}};
  // 4 m of water and 6 m beyond it. The vehicle centre keeps half the vehicle length from water and
  // tunnel end; a place of the corridor counts within half the tunnel width from there.
  EXPECT_NEAR(complete_m - test::MissionTruth(world).score({}).corridor_m, 10.0,
              0.6);  // one place and half a cell
}

class MissionInAMine : public testing::Test {
 protected:
  std::filesystem::path run(const WorldChoice& world, const std::string& name, double time_max_s,
                            const std::filesystem::path& config = {}) {
    MissionRunOptions options;
    options.world = world;
    options.config = config;
    options.folder = scratch_ / name;
    options.time_max_s = time_max_s;
    run_mission(options);
    return options.folder / "run.lcmlog";
  }

  void expect_success(const WorldChoice& world) {
    const auto log = test::read_mission(run(world, "mission", 1200.0));
    const test::MissionScore score = test::MissionTruth(build_world(describe(world))).score(log);
    EXPECT_EQ(score.outcome, "home") << score.reason;
    EXPECT_LE(score.distance_from_start_m, 0.5);
    EXPECT_LE(score.rmse_m, 0.2);
    EXPECT_GT(score.farthest_m, 5.0);
    EXPECT_GT(score.scans, 0);
    ASSERT_FALSE(log.phases.empty());
    const auto within_m = log.phases.back().home_within_m;
    ASSERT_TRUE(within_m) << score.reason;
    EXPECT_LE(score.distance_from_start_m, *within_m);  // with 95 %; seeds are fixed
    EXPECT_LE(*within_m, 0.5 + 0.5);                    // home_tolerance_m and the uncertainty
  }

  test::ScratchFolder scratch_;
};

TEST_F(MissionInAMine, ReturnsFromABranchingMine) { expect_success(small_mine(4, "branching")); }

TEST_F(MissionInAMine, ReturnsFromParallelEntries) {
  expect_success(small_mine(5, "parallel_entries"));
}

/// The entrance is out of range of the rear laser after 44 m; then scan matching is degenerate.
TEST_F(MissionInAMine, ReturnsFromASmoothTunnelWithoutOdometryAndGyro) {
  const auto config = scratch_ / "blind.yaml";
  std::ofstream(config) << "sim: {wheel_odometry: {present: false}, imu: {present: false}}\n";
  WorldChoice straight;
  straight.name = "straight";
  const auto log = test::read_mission(run(straight, "straight", 220.0, config));
  const test::MissionScore score = test::MissionTruth(build_world(describe(straight))).score(log);
  ASSERT_FALSE(log.phases.empty());
  EXPECT_TRUE(log.phases.back().returning_home);
  EXPECT_THAT(log.phases.back().return_home_reason,
              testing::HasSubstr("no sensor measured the motion"));
  EXPECT_GT(score.farthest_m, 40.0);
  EXPECT_LT(score.farthest_m, 44.0 + 10.0 * 0.5);  // maximum speed for ten seconds
}

TEST_F(MissionInAMine, GivesTheSameLogTwice) {
  const WorldChoice world = small_mine(4, "branching");
  const std::string first = test::contents(run(world, "first", 60.0));
  EXPECT_GT(first.size(), 1'000'000U);
  EXPECT_TRUE(first == test::contents(run(world, "second", 60.0)));
}

}  // namespace
}  // namespace adit
