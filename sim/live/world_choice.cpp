// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/world_choice.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <CLI/App.hpp>

#include "common/command_line/command_line.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/random_mine.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

constexpr const char* kRandom = "random";
constexpr const char* kRandomLevel = "random_level";
constexpr int kFirstSeed = 1;
constexpr double kSleeperTopM = 0.02;  // on which a wheel beside a rail does not stand
constexpr double kBesideRailM = 0.2;   // of the body from the rail, and from the wall

RandomMineParams random_params(const WorldChoice& choice) {
  RandomMineParams params;
  params.length_m = choice.length_m.value_or(params.length_m);
  params.topology = choice.topology.value_or(params.topology);
  params.damage = choice.damage.value_or(params.damage);
  params.level = choice.name == kRandomLevel;
  return params;
}

/// Rails in whose gauge the start lies; nullptr without any.
const RailsDescription* rails_at_start(const WorldDescription& world,
                                       const std::vector<TunnelLine>& tunnels) {
  for (const RailsDescription& rails : world.props.rails) {
    const TunnelLine::Place start =
        find_tunnel(tunnels, rails.tunnel, "rails").place_of(world.T_world_start.translation());
    const bool is_along = start.s_m >= rails.from_m && start.s_m <= rails.to_m;
    if (is_along && std::abs(start.across_m - rails.across_m) < rails.gauge_m) return &rails;
  }
  return nullptr;
}

bool is_random(const WorldChoice& choice) {
  return choice.name == kRandom || choice.name == kRandomLevel;
}

}  // namespace

CLI::Option* add_world_options(CLI::App& app, WorldChoice& choice) {
  CLI::Option* world = app.add_option(
      "WORLD", choice.name,
      "A built-in world, random, random_level, two_levels, grade:PERCENT, narrow:METRES, a world "
      "file, or a mesh");
  app.add_option("--seed", choice.seed, "Seed of everything random, instead of that of the world")
      ->type_name("N")
      ->check(number_in(at_least(0.0)));
  app.add_option("--length-m", choice.length_m,
                 "Approximate length of all tunnels of a random mine")
      ->type_name("METRES")
      ->check(number_in(within(30.0, 5000.0)));
  app.add_option("--topology", choice.topology, "Topology of a random mine")
      ->type_name("NAME")
      ->check(CLI::IsMember({"any", "parallel_entries", "room_and_pillar", "branching", "ring"}));
  app.add_option(
         "--damage", choice.damage,
         "Fraction of the tunnels of a random mine with roof falls, water, pits or low roof")
      ->type_name("SHARE")
      ->check(number_in(within(0.0, 1.0)));
  return world;
}

WorldDescription describe(const WorldChoice& choice) {
  const bool of_random = choice.length_m || choice.topology || choice.damage;
  if (of_random && !is_random(choice)) {
    throw std::invalid_argument(
        "--length-m, --topology and --damage are for the worlds random and random_level");
  }
  if (!of_random) return find_world(choice.name, choice.seed);
  return random_mine(choice.seed.value_or(kFirstSeed), random_params(choice));
}

WorldDescription describe(const WorldChoice& choice, const Vehicle& vehicle) {
  WorldDescription world = describe(choice);
  if (!is_random(choice)) return world;
  const std::vector<TunnelLine> tunnels = tunnel_lines(world.plan);
  const RailsDescription* const rails = rails_at_start(world, tunnels);
  if (rails == nullptr || vehicle.step_max_m > rails->height_m + kSleeperTopM) return world;
  const TunnelLine& tunnel = find_tunnel(tunnels, rails->tunnel, "rails");
  const double s_m = tunnel.place_of(world.T_world_start.translation()).s_m;
  const double across_m = rails->across_m + 0.5 * rails->gauge_m + rails->height_m + kBesideRailM +
                          0.5 * vehicle.width_m;
  if (across_m + 0.5 * vehicle.width_m + kBesideRailM > 0.5 * tunnel.width_m) return world;
  const Eigen::Vector2d p_world = tunnel.beside(s_m, across_m);
  world.T_world_start.x = p_world.x();
  world.T_world_start.y = p_world.y();
  return world;
}

}  // namespace adit
