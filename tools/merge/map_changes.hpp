// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace adit {

struct MapChangesParams {
  int hits_min = 3;             ///< scans that observed a wall,
  double wall_share_min = 0.3;  ///< and their share of those that observed its cell
  int misses_min = 5;           ///< scans that observed free space through a cell
  double hit_share_max = 0.1;   ///< of these, in free space
  double clearance_m = 0.25;    ///< free space of the one around a wall of the other: runs lie on
                                ///< each other to less than this
  double length_min_m = 0.4;    ///< of a change, the larger side of the box around it
  double gap_m = 0.4;           ///< cells nearer than this are one change

  template <class V>
  void visit(V& v) {
    v("hits_min", hits_min, at_least(1));
    v("wall_share_min", wall_share_min, within(0.0, 1.0));
    v("misses_min", misses_min, at_least(1));
    v("hit_share_max", hit_share_max, within(0.0, 1.0));
    v("clearance_m", clearance_m, at_least(0.0));
    v("length_min_m", length_min_m, at_least(0.0));
    v("gap_m", gap_m, at_least(0.0));
  }
};

/// A place where some runs saw a wall and others free space.
struct MapChange {
  enum class Kind : std::uint8_t {
    kAppeared,  ///< all runs that saw it free are before those that saw a wall
    kVanished,  ///< the reverse
    kDiffers,   ///< neither: it came and went, or the robots see differently
  };

  Kind kind = Kind::kDiffers;
  Eigen::Vector2d p_map{0.0, 0.0};     ///< middle of its cells [m]
  Eigen::Vector2d size_m{0.0, 0.0};    ///< of the box around it, along the axes of the map
  std::vector<Eigen::Vector2d> cells;  ///< middles, p_map [m]
  std::vector<std::size_t> wall_runs;  ///< indices of the grids, ascending
  std::vector<std::size_t> free_runs;
};

/// Compares the grids of runs, in their order of time, in one map and with one resolution: where
/// both are well seen, a wall of one that lies in free space of another is a change. What is not
/// well seen is no evidence. Largest first.
std::vector<MapChange> find_changes(const std::vector<OccupancyGrid>& runs,
                                    const MapChangesParams& params);

}  // namespace adit
