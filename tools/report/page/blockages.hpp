// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/types/exploration.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A place where the exploration ended before an unexplored frontier: what blocked it there, and
/// what is known of the mine behind it.
struct Blockage {
  double at_m = 0.0;           ///< distance travelled until the robot first was near [m]
  double seen_beyond_m = 0.0;  ///< from the nearest pose to the farthest ground seen behind it [m]
  double frontier_m = 0.0;     ///< total width of the frontiers behind it [m]
  std::string cause;           ///< "water", "an obstacle", .., with what decides
  bool is_proven = false;      ///< the evidence shows that there is no path
  std::vector<int> frontiers;  ///< their ids
};

/// The blockages of a mission, from the frontiers that are neither explored nor outside the mine
/// nor still to be visited, in the order in which the robot passed them. Frontiers whose nearest
/// poses are close to each other are behind one blockage. `path` is T_map_body; `grid` may be null:
/// the frontiers are what was seen then.
std::vector<Blockage> blockages(const std::vector<Frontier>& frontiers, const Trajectory& path,
                                const OccupancyGrid* grid);

}  // namespace adit
