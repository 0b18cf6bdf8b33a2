// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/exploration.hpp"
#include "procs/exploration/frontier/frontier_detection.hpp"
#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

struct CorridorGraphParams {
  double dead_end_min_m = 2.0;  ///< length beyond the corridor wall; shorter branches are niches

  template <class V>
  void visit(V& v) {
    v("dead_end_min_m", dead_end_min_m, at_least(0.0));
  }
};

/// The topological map of the mine: the skeleton graph without the spurs that rough walls cause.
/// In atlas. Niches are not dead ends, and junctions within the width of a corridor are merged.
/// Where the walls of a corridor are not known, its width is twice the least clearance.
CorridorGraph corridor_graph(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton,
                             const std::vector<DetectedFrontier>& frontiers,
                             const CorridorGraphParams& params);

}  // namespace adit
