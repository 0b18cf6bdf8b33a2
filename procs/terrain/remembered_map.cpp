// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/remembered_map.hpp"

#include "procs/terrain/narrow_gaps.hpp"

namespace adit {

RememberedMap::RememberedMap(const TerrainMap& map, double way_m)
    : finder_(map), T_odom_level_(map.T_odom_level), way_m_(way_m) {
  cells_.reserve(map.cells.size());
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const TerrainCell& cell = map.at(column, row);
      const Ground ground = is_narrow_gap(map, column, row) ? Ground::kNeverSeen : cell.ground;
      cells_.push_back({cell.low_m, cell.high_m, cell.clearance_m, cell.count, ground});
    }
  }
}

}  // namespace adit
