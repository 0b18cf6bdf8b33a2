// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/expected_gain.hpp"

#include <algorithm>
#include <optional>

namespace adit {
namespace {

constexpr double kFirstM = 1.0;  // from the stub, beyond the rim of what was seen

/// How far it is straight ahead to what is known.
std::optional<double> known_ahead_m(const Stub& stub, const DrivableSpace& space, double look_m) {
  for (double way = kFirstM; way < look_m; way += space.resolution_m) {
    const Eigen::Vector2i cell = space.cell_at(stub.p_map + way * stub.direction_map);
    if (space.known.get(cell, Known::kUnseen) != Known::kUnseen) return way;
  }
  return std::nullopt;
}

}  // namespace

double mean_corridor_m(const CorridorGraph& corridors, const ExpectedGainParams& params) {
  double sum = params.prior_weight * params.prior_m;
  double weight = params.prior_weight;
  const auto is_open = [&](int node) {
    return corridors.nodes[static_cast<std::size_t>(node)].kind == CorridorNode::Kind::kOpenEnd;
  };
  for (const Corridor& corridor : corridors.corridors) {
    if (is_open(corridor.from) || is_open(corridor.to)) continue;
    sum += corridor.length_m;
    weight += 1.0;
  }
  return weight > 0.0 ? sum / weight : params.prior_m;
}

double expected_gain_m(const Stub& stub, const DrivableSpace& space, double mean_m, double sd_m,
                       const ExpectedGainParams& params) {
  const auto ahead = known_ahead_m(stub, space, params.look_m);
  if (!ahead) return std::max(mean_m, params.least_m);
  return std::max(std::min(*ahead, mean_m), params.least_m) + params.loop_factor * sd_m;
}

}  // namespace adit
