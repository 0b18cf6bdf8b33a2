// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/world_choice.hpp"

#include <stdexcept>

#include <CLI/App.hpp>

#include "common/command_line/command_line.hpp"
#include "sim/world/random/random_mine.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

constexpr const char* kRandom = "random";
constexpr const char* kRandomLevel = "random_level";
constexpr int kFirstSeed = 1;

RandomMineParams random_params(const WorldChoice& choice) {
  RandomMineParams params;
  params.length_m = choice.length_m.value_or(params.length_m);
  params.topology = choice.topology.value_or(params.topology);
  params.damage = choice.damage.value_or(params.damage);
  params.level = choice.name == kRandomLevel;
  return params;
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
  if (of_random && choice.name != kRandom && choice.name != kRandomLevel) {
    throw std::invalid_argument(
        "--length-m, --topology and --damage are for the worlds random and random_level");
  }
  if (!of_random) return find_world(choice.name, choice.seed);
  return random_mine(choice.seed.value_or(kFirstSeed), random_params(choice));
}

}  // namespace adit
