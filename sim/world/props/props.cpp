// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/props.hpp"

#include <cstddef>
#include <memory>
#include <random>
#include <string>

#include <fmt/format.h>

#include "sim/world/props/prop_site.hpp"

namespace adit {
namespace {

/// Name of a prop as in the world file: `props.posts[2]`.
std::string prop_name(const std::string& list, std::size_t index) {
  return fmt::format("props.{}[{}]", list, index);
}

}  // namespace

void apply_height_changes(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
                          Heights& heights) {
  const auto bare = std::make_shared<const Heights>(heights);
  for (std::size_t i = 0; i < props.rubble.size(); ++i) {
    const RubbleDescription& rubble = props.rubble[i];
    heights.change_roof(cavity_above(
        rubble, tunnel_with(tunnels, rubble.tunnel, rubble.at_m, prop_name("rubble", i))));
  }
  for (std::size_t i = 0; i < props.low_roofs.size(); ++i) {
    const LowRoofDescription& low = props.low_roofs[i];
    const TunnelLine& tunnel =
        tunnel_with(tunnels, low.tunnel, low.from_m, low.to_m, prop_name("low_roofs", i));
    heights.change_roof(lowered_roof(low, tunnel, bare));
  }
  for (std::size_t i = 0; i < props.water.size(); ++i) {
    const WaterDescription& water = props.water[i];
    const TunnelLine& tunnel =
        tunnel_with(tunnels, water.tunnel, water.from_m, water.to_m, prop_name("water", i));
    heights.change_floor(hollow_under(water, tunnel, *bare));
  }
  for (std::size_t i = 0; i < props.pits.size(); ++i) {
    const PitDescription& pit = props.pits[i];
    heights.change_floor(
        pit_in_floor(pit, tunnel_with(tunnels, pit.tunnel, pit.at_m, prop_name("pits", i))));
  }
}

void add_props(const PropDescriptions& props, const std::vector<TunnelLine>& tunnels,
               const Heights& heights, int seed, MeshBuilder& builder, World& world) {
  int kind = 0;
  const auto add = [&](const std::string& list, const auto& descriptions) {
    ++kind;
    for (std::size_t i = 0; i < descriptions.size(); ++i) {
      std::seed_seq sequence{seed, kind, static_cast<int>(i)};
      PropSite site{
          tunnels, heights, builder, world, prop_name(list, i), std::mt19937_64(sequence)};
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
