// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/world_description.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace adit {

/// Which mine, as a command line says it.
struct WorldChoice {
  std::string name;         ///< as find_world takes it
  std::optional<int> seed;  ///< instead of that of the world

  // Of a random mine; RandomMineParams without.
  std::optional<double> length_m;
  std::optional<std::string> topology;
  std::optional<double> damage;
};

/// Declares WORLD, which is returned, and its options.
CLI::Option* add_world_options(CLI::App& app, WorldChoice& choice);

/// Throws as find_world does, and std::invalid_argument where what is said of a random mine is said
/// of another.
WorldDescription describe(const WorldChoice& choice);

}  // namespace adit
