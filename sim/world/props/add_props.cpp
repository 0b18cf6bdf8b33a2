// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props.hpp"
#include "sim/world/props/add_prop.hpp"
#include "sim/world/props/prop_name.hpp"

namespace adit {

void add_props(const PropDescriptions& props, const std::vector<DriftLine>& drifts,
               const Heights& heights, int seed, MeshBuilder& builder, World& world) {
  int kind = 0;
  const auto add = [&](const std::string& list, const auto& descriptions) {
    ++kind;
    for (std::size_t i = 0; i < descriptions.size(); ++i) {
      std::seed_seq sequence{seed, kind, static_cast<int>(i)};
      PropSite site{drifts, heights, builder, world, prop_name(list, i), std::mt19937_64(sequence)};
      add_prop(descriptions[i], site);
    }
  };
  add("rails", props.rails);
  add("posts", props.posts);
  add("cribs", props.cribs);
  add("rubble", props.rubble);
  add("beams", props.beams);
  add("cars", props.cars);
  add("low_roofs", props.low_roofs);
  add("pits", props.pits);
  add("water", props.water);
  add("mud", props.mud);
  add("gas", props.gas);
}

}  // namespace adit
