// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/props.hpp"

#include <algorithm>
#include <memory>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/placement.hpp"
#include "sim/world/props/prop_site.hpp"
#include "sim/world/props/water.hpp"

namespace adit {
namespace {

// Horizontal width of the sides of a pit [m].
constexpr double kPitSide = 0.1;

// Volume of fallen rock relative to that of its cavity.
constexpr double kBulking = 1.5;

using Tunnels = std::vector<TunnelLine>;

HeightChange pit(const PitDescription& pit, const TunnelLine& tunnel) {
  const Eigen::Vector2d middle = tunnel.beside(pit.at_m, pit.across_m);
  const PlanBox box = box_around(middle, pit.radius_m);
  return {box.low, box.high, [pit, middle](const Eigen::Vector2d& p_world, double floor_m) {
            const double from_edge_m = pit.radius_m - (p_world - middle).norm();
            return floor_m - pit.depth_m * std::clamp(from_edge_m / kPitSide, 0.0, 1.0);
          }};
}

/// A paraboloid above the cone. On the same base, they have half and a third of the volume of their
/// cylinder.
HeightChange cavity(const RubbleDescription& rubble, const TunnelLine& tunnel) {
  const Eigen::Vector2d middle = tunnel.beside(rubble.at_m, rubble.across_m);
  const double rise_m = rubble.height_m * (2.0 / 3.0) / kBulking;
  const PlanBox box = box_around(middle, rubble.radius_m);
  return {box.low, box.high,
          [=, radius_m = rubble.radius_m](const Eigen::Vector2d& p_world, double roof_m) {
            const double share2 = (p_world - middle).squaredNorm() / (radius_m * radius_m);
            return roof_m + rise_m * std::max(0.0, 1.0 - share2);
          }};
}

/// `bare` has the floor without pits and hollows, to which the clearance refers.
HeightChange low_roof(const LowRoofDescription& low, const TunnelLine& tunnel,
                      const std::shared_ptr<const Heights>& bare) {
  const PlanBox box = box_around(section_outline(tunnel, low.from_m, low.to_m));
  return {box.low, box.high, [low, tunnel, bare](const Eigen::Vector2d& p_world, double roof_m) {
            const double share = fraction_of_section(tunnel, low.from_m, low.to_m, p_world);
            return share < 0.0 ? roof_m : std::min(roof_m, bare->floor(p_world) + low.clearance_m);
          }};
}

}  // namespace

void apply_height_changes(const PropDescriptions& props, const Tunnels& tunnels, Heights& heights) {
  const auto bare = std::make_shared<const Heights>(heights);
  for (std::size_t i = 0; i < props.rubble.size(); ++i) {
    const RubbleDescription& rubble = props.rubble[i];
    heights.change_roof(
        cavity(rubble, tunnel_with(tunnels, rubble.tunnel, rubble.at_m, prop_name("rubble", i))));
  }
  for (std::size_t i = 0; i < props.low_roofs.size(); ++i) {
    const LowRoofDescription& low = props.low_roofs[i];
    const TunnelLine& tunnel =
        tunnel_with(tunnels, low.tunnel, low.from_m, low.to_m, prop_name("low_roofs", i));
    heights.change_roof(low_roof(low, tunnel, bare));
  }
  for (std::size_t i = 0; i < props.water.size(); ++i) {
    const WaterDescription& water = props.water[i];
    const TunnelLine& tunnel =
        tunnel_with(tunnels, water.tunnel, water.from_m, water.to_m, prop_name("water", i));
    heights.change_floor(water_hollow(water, tunnel, water_level(water, tunnel, *bare)));
  }
  for (std::size_t i = 0; i < props.pits.size(); ++i) {
    const PitDescription& hole = props.pits[i];
    heights.change_floor(
        pit(hole, tunnel_with(tunnels, hole.tunnel, hole.at_m, prop_name("pits", i))));
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
