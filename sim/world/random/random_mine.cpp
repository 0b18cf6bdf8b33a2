// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/random_mine.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>

#include "sim/world/random/random_props.hpp"
#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

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
  throw std::invalid_argument("unknown topology '" + name +
                              "'; known: any, parallel_entries, room_and_pillar, branching, ring");
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

}  // namespace

WorldDescription random_mine(int seed, const RandomMineParams& params) {
  RandomGenerator rng(static_cast<std::uint64_t>(seed));
  WorldDescription description;
  description.name = "random_" + std::to_string(seed);
  description.seed = seed;
  description.T_world_start = {3.0, 0.0, 0.0};
  description.plan = find_topology(params.topology, rng)(params.length_m, rng);
  description.heights = random_heights(params.length_m, rng);
  description.wall_relief = {.height_m = rng.between(0.05, 0.18), .length_m = 1.5};
  description.props = random_props(description.plan, params.damage, rng);
  return description;
}

}  // namespace adit
