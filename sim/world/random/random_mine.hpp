// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Parameters of a random mine.
struct RandomMineParams {
  std::string topology = "any";  ///< any, parallel_entries, room_and_pillar, branching or ring
  double length_m = 300.0;       ///< approximate, of all tunnels
  double damage = 0.5;           ///< fraction of tunnels with roof falls, water, pits or low roof
  bool level = false;            ///< slopes of 1.2 % at most: random_level

  template <class V>
  void visit(V& v) {
    v("topology", topology,
      OneOf({"any", "parallel_entries", "room_and_pillar", "branching", "ring"}));
    v("length_m", length_m, within(30.0, 5000.0));
    v("damage", damage, within(0.0, 1.0));
    v("level", level);
  }
};

/// Generates a random mine: the same parameters and seed give the same description. It has an
/// entrance and at least 20 m of undamaged tunnel behind it. A mine that is not level has the plan
/// of the level one, with relief (add_relief). Throws std::invalid_argument for an unknown
/// topology.
WorldDescription random_mine(int seed, const RandomMineParams& params = {});

}  // namespace adit
