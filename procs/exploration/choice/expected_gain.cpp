// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/expected_gain.hpp"

#include <algorithm>
#include <optional>

namespace adit {
namespace {

constexpr double kFirstM = 1.0;  // from the frontier; skips the rim of the known space

/// Distance straight ahead to known space; empty if there is none within the lookahead.
std::optional<double> known_ahead_m(const Frontier& frontier, const DrivableSpace& space,
                                    double lookahead_m) {
  for (double distance = kFirstM; distance < lookahead_m; distance += space.resolution_m) {
    const Eigen::Vector2i cell = space.cell_at(frontier.p_map + distance * frontier.direction_map);
    if (space.known.get(cell, Occupancy::kUnseen) != Occupancy::kUnseen) return distance;
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

double expected_gain_m(const Frontier& frontier, const DrivableSpace& space, double mean_m,
                       double sd_m, const ExpectedGainParams& params) {
  const auto ahead = known_ahead_m(frontier, space, params.lookahead_m);
  if (!ahead) return std::max(mean_m, params.gain_min_m);
  return std::max(std::min(*ahead, mean_m), params.gain_min_m) + params.loop_factor * sd_m;
}

}  // namespace adit
