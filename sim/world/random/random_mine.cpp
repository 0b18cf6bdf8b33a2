// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_mine.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/text/message_text.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/random/random_generator.hpp"
#include "sim/world/random/random_relief.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kPlaceEvery = 12.0;  // longer than the props of one place [m]
constexpr double kFromEnds =
    4.0;  // distance of places from the junctions at the ends of a tunnel [m]
constexpr double kPostsShare = 0.3;  // of the places without damage
constexpr double kRailsShare = 0.6;  // of the mines
// The relief has random numbers of its own, so that level mines stay as they are.
constexpr std::uint64_t kReliefStream = 0x5eed0f7e1ef00000U;
constexpr double kReach = 5.0;  // of the largest prop from its place [m]

using Topology = PlanDescription (*)(double length_m, RandomGenerator& rng);

struct NamedTopology {
  const char* name;
  Topology make;
};

constexpr std::array<NamedTopology, 4> kTopologies{{{"parallel_entries", parallel_entries},
                                                    {"room_and_pillar", room_and_pillar},
                                                    {"branching", branching},
                                                    {"ring", ring}}};

Topology find_topology(const std::string& name, RandomGenerator& rng) {
  const int any = rng.between(0, static_cast<int>(kTopologies.size()) - 1);
  if (name == "any") return kTopologies[static_cast<std::size_t>(any)].make;
  for (const NamedTopology& topology : kTopologies) {
    if (name == topology.name) return topology.make;
  }
  throw std::invalid_argument(fmt::format(
      "unknown topology {}; known: any, parallel_entries, room_and_pillar, branching, ring",
      quote(name)));
}

HeightsDescription random_heights(double length_m, RandomGenerator& rng) {
  HeightsDescription heights;
  const double slope = rng.between(-0.012, 0.012);
  heights.profile_m = {0.0, 0.0, length_m, slope * length_m};
  heights.heading_rad = rng.between(-0.5, 0.5);
  heights.floor_relief = {.height_m = rng.between(0.01, 0.05), .length_m = 2.5};
  heights.roof_relief = {.height_m = rng.between(0.03, 0.15), .length_m = 2.0};
  // Between 1.6 m and 2.6 m with the reliefs.
  const double relief_m = heights.floor_relief.height_m + heights.roof_relief.height_m;
  heights.clearance_m = rng.between(1.6 + relief_m, 2.6 - relief_m);
  return heights;
}

/// A place for a prop.
struct Place {
  const TunnelLine& tunnel;
  double at_m;

  [[nodiscard]] double half_width_m() const { return tunnel.width_m / 2.0; }
};

double beside_wall(const Place& place, double from_wall_m, RandomGenerator& rng) {
  return rng.side() * std::max(0.0, place.half_width_m() - from_wall_m);
}

void add_posts(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.posts.push_back({.tunnel = place.tunnel.name,
                         .from_m = place.at_m - 3.0,
                         .to_m = place.at_m + 3.0,
                         .every_m = rng.between(1.5, 3.0),
                         .across_m = beside_wall(place, 0.35, rng),
                         .both_sides = place.tunnel.width_m > 3.5 && rng.chance(0.4)});
}

void add_crib(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.cribs.push_back({.tunnel = place.tunnel.name,
                         .at_m = place.at_m,
                         .across_m = beside_wall(place, 0.5, rng),
                         .side_m = rng.between(0.6, 1.0)});
}

void add_rubble(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.rubble.push_back({.tunnel = place.tunnel.name,
                          .at_m = place.at_m,
                          .across_m = rng.between(-1.0, 1.0) * place.half_width_m(),
                          .radius_m = rng.between(0.8, 2.5),
                          .height_m = rng.between(0.3, 2.0)});
}

void add_low_roof(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  const double half_m = rng.between(1.0, 3.5);
  props.low_roofs.push_back({.name = fmt::format("low_roof_{}", props.low_roofs.size() + 1),
                             .tunnel = place.tunnel.name,
                             .from_m = place.at_m - half_m,
                             .to_m = place.at_m + half_m,
                             .clearance_m = rng.between(0.6, 1.4)});
}

void add_pit(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.pits.push_back({.name = fmt::format("pit_{}", props.pits.size() + 1),
                        .tunnel = place.tunnel.name,
                        .at_m = place.at_m,
                        .across_m = rng.between(-0.8, 0.8) * place.half_width_m(),
                        .radius_m = rng.between(0.4, 1.2),
                        .depth_m = rng.between(0.4, 2.0)});
}

void add_water(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  const double half_m = rng.between(1.5, 3.8);
  props.water.push_back({.name = fmt::format("water_{}", props.water.size() + 1),
                         .tunnel = place.tunnel.name,
                         .from_m = place.at_m - half_m,
                         .to_m = place.at_m + half_m,
                         .depth_m = rng.between(0.1, 0.8),
                         .mirror = rng.chance(0.3)});
}

void add_mud(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.mud.push_back({.name = fmt::format("mud_{}", props.mud.size() + 1),
                       .tunnel = place.tunnel.name,
                       .at_m = place.at_m,
                       .radius_m = rng.between(1.0, 3.0),
                       .depth_m = rng.between(0.05, 0.3)});
}

void add_beam(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.beams.push_back({.tunnel = place.tunnel.name,
                         .at_m = place.at_m,
                         .thickness_m = rng.between(0.15, 0.3),
                         .yaw_rad = rng.between(-0.8, 0.8),
                         .high_end_m = rng.between(0.9, 1.5),
                         .cables = rng.between(0, 3),
                         .cable_sag_m = rng.between(0.3, 1.0)});
}

void add_car(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  props.cars.push_back({.tunnel = place.tunnel.name,
                        .at_m = place.at_m,
                        .across_m = rng.chance(0.5) ? 0.0 : beside_wall(place, 0.8, rng),
                        .width_m = rng.between(0.8, 1.1)});
}

void add_damage(const Place& place, RandomGenerator& rng, PropDescriptions& props) {
  using Add = void (*)(const Place&, RandomGenerator&, PropDescriptions&);
  // Roof falls are the most frequent damage; cribs support roofs at risk.
  constexpr std::array<Add, 10> kKinds{add_rubble, add_rubble, add_rubble, add_crib, add_low_roof,
                                       add_pit,    add_water,  add_mud,    add_beam, add_car};
  const int kind = rng.between(0, static_cast<int>(kKinds.size()) - 1);
  kKinds[static_cast<std::size_t>(kind)](place, rng, props);
}

/// The tunnel behind the entrance is undamaged; branches begin beyond that.
bool is_undamaged(const Place& place) {
  return place.tunnel.at(place.at_m).p_world.norm() < kUndamagedLength + kReach;
}

void add_rails(const TunnelLine& main, PropDescriptions& props) {
  props.rails.push_back(
      {.tunnel = main.name, .from_m = 1.0, .to_m = main.length_m() - 2.0, .gauge_m = 0.6});
}

/// The props along all tunnels except the first metres behind the entrance: damage at the fraction
/// `damage` of the places, and intact posts between them.
PropDescriptions random_props(const PlanDescription& plan, double damage, RandomGenerator& rng) {
  PropDescriptions props;
  const std::vector<TunnelLine> tunnels = tunnel_lines(plan);
  if (rng.chance(kRailsShare)) add_rails(tunnels.front(), props);
  for (const TunnelLine& tunnel : tunnels) {
    const double last_m = tunnel.length_m() - kFromEnds - kPlaceEvery / 2.0;
    for (double s_m = kFromEnds; s_m <= last_m; s_m += kPlaceEvery) {
      const Place place{tunnel, s_m + rng.between(4.0, 6.0)};
      const bool damaged = rng.chance(damage);
      const bool posts = rng.chance(kPostsShare);
      if (is_undamaged(place)) continue;
      if (damaged) {
        add_damage(place, rng, props);
      } else if (posts) {
        add_posts(place, rng, props);
      }
    }
  }
  return props;
}

}  // namespace

WorldDescription random_mine(int seed, const RandomMineParams& params) {
  RandomGenerator rng(static_cast<std::uint64_t>(seed));
  WorldDescription description;
  description.name = fmt::format("random_{}", seed);
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  description.plan = find_topology(params.topology, rng)(params.length_m, rng);
  description.heights = random_heights(params.length_m, rng);
  description.wall_relief = {.height_m = rng.between(0.05, 0.18), .length_m = 1.5};
  description.props = random_props(description.plan, params.damage, rng);
  if (params.level) return description;
  description.name = fmt::format("random_uneven_{}", seed);
  RandomGenerator relief_rng(static_cast<std::uint64_t>(seed) ^ kReliefStream);
  add_relief(description, relief_rng);
  return description;
}

}  // namespace adit
