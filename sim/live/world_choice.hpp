// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "common/types/vehicle.hpp"
#include "sim/world/world_description.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace adit {

/// Selection of a world on a command line.
struct WorldChoice {
  std::string name;         ///< for find_world()
  std::optional<int> seed;  ///< instead of that of the world

  // Of a random mine; defaults: RandomMineParams.
  std::optional<double> length_m;
  std::optional<std::string> topology;
  std::optional<double> damage;
};

/// Declares the argument WORLD, which is returned, and its options.
CLI::Option* add_world_options(CLI::App& app, WorldChoice& choice);

/// Throws as find_world() does, and std::invalid_argument for options of random mines with another
/// world.
WorldDescription describe(const WorldChoice& choice);

/// The same for a vehicle: a random mine has its start beside the rails if their height is more
/// than it climbs, where the tunnel has room there.
WorldDescription describe(const WorldChoice& choice, const Vehicle& vehicle);

}  // namespace adit
