// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/merge/generated_runs.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/world/build_world.hpp"
#include "sim/world/random/random_mine.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/drives/walked_map.hpp"

namespace adit {
namespace {

constexpr double kLengthM = 100.0;
constexpr double kLaserHeightM = 0.6;
constexpr double kWalkM = 60.0;
constexpr std::array<const char*, 4> kTopologies{"parallel_entries", "room_and_pillar", "branching",
                                                 "ring"};
constexpr std::array<double, 2> kRobotLasersM{1.05, 0.7};

const char* topology(int seed) {
  // Mines of neighbouring seeds have the same topology, so that they are as similar as can be.
  return kTopologies[static_cast<std::size_t>(seed / 10) % kTopologies.size()];
}

WorldDescription description(int seed) {
  RandomMineParams params;
  params.topology = topology(seed);
  params.length_m = params.topology == "ring" ? 115.0 : kLengthM;  // a shorter one has no loop
  params.damage = 0.0;
  params.level = true;
  WorldDescription mine = random_mine(seed, params);
  mine.heights.profile_m = {};
  mine.heights.rolls.height_m = 0.0;
  mine.props = {};
  return mine;
}

/// The nodes from which a tunnel leads, in order; the others are those of pillars and panels.
std::vector<int> tunnel_nodes(const TunnelGraph& tunnels) {
  std::set<int> nodes;
  for (const TunnelEdge& edge : tunnels.edges) nodes.insert({edge.from, edge.to});
  return {nodes.begin(), nodes.end()};
}

TrueRun walk(const std::string& name, const test::WallWorld& world,
             const std::vector<Eigen::Vector2d>& path, int seed, int robot) {
  test::WalkOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  options.lasers = test::lasers_at_ends(kRobotLasersM[static_cast<std::size_t>(robot % 2)]);
  test::WalkedMap walked = test::walked_map(world, path, options);
  Trajectory truth;
  for (const auto& [utime, pose] : walked.truth) truth.push_back({utime, pose});
  return {name, std::move(walked.map), std::move(truth)};
}

TrueRun walk_everywhere(const std::string& name, const WorldDescription& mine, int seed,
                        int robot) {
  const World world = build_world(mine);
  const TunnelGraph tunnels = world.truth.tunnels;
  return walk(name, test::WallWorld(world, kLaserHeightM), test::tour(tunnels, 0, 4.0 * kLengthM),
              seed, robot);
}

}  // namespace

std::string mine_name(int seed) { return fmt::format("{} ({})", seed, topology(seed)); }

std::vector<TrueRun> ten_runs(int seed) {
  const World built = build_world(description(seed));
  const TunnelGraph tunnels = built.truth.tunnels;
  const test::WallWorld world(built, kLaserHeightM);
  const std::vector<int> places = tunnel_nodes(tunnels);
  double walk_m = kWalkM;  // each walk goes through a whole tunnel at least
  for (const TunnelEdge& edge : tunnels.edges) walk_m = std::max(walk_m, edge.length_m);
  const std::array<int, 3> starts{places.front(), places[places.size() / 2], places.back()};
  std::vector<TrueRun> runs;
  for (int i = 0; i < 10; ++i) {
    const auto path = test::tour(tunnels, starts[static_cast<std::size_t>(i % 3)], 2.0 * walk_m,
                                 static_cast<std::size_t>(i / 3));
    runs.push_back(walk(fmt::format("{}.{}", seed, i + 1), world, path, 100 * seed + i, i / 3));
  }
  return runs;
}

TrueRun whole_mine(int seed, int robot) {
  return walk_everywhere(mine_name(seed), description(seed), 100 * seed + robot, robot);
}

TrueRun mine_with_other_walls(int seed) {
  WorldDescription mine = description(seed);
  mine.seed += 1000;
  return walk_everywhere(mine_name(seed) + ", other walls", mine, 100 * seed + 50, 1);
}

TrueRun straight_tunnel_run(int seed, int variant) {
  WorldDescription mine = find_world("straight");
  const double branch_m = 44.0 + 2.0 * (seed % 4) + 3.0 * variant;
  const double side = variant == 0 ? 1.0 : -1.0;
  mine.plan.tunnels = {
      {.name = "tunnel", .points_m = {0.0, 0.0, 60.0, 0.0}, .width_m = 3.2},
      {.name = "branch", .points_m = {branch_m, 0.0, branch_m + 3.0, side * 20.0}, .width_m = 3.0}};
  return walk(
      fmt::format("branch {:+.0f} m at {:.0f} m", side, branch_m),
      test::WallWorld(build_world(mine), kLaserHeightM),
      {{3.0, 0.0}, {branch_m, 0.0}, {branch_m + 2.5, side * 17.0}, {branch_m, 0.0}, {6.0, 0.0}},
      10 * seed + variant, variant);
}

}  // namespace adit
