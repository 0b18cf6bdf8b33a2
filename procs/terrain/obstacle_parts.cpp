// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/obstacle_parts.hpp"

#include "procs/terrain/cell_heights.hpp"
#include "procs/terrain/memory/remembered_map.hpp"

namespace adit {
namespace {

// Above the vehicle, which the planner keeps from the roof (planning.c_space.ground.roof_margin_m).
constexpr float kRoofM = 0.15F;

}  // namespace

void set_obstacle_parts(TerrainMap& map, const Cloud& cloud, const Vehicle& vehicle) {
  const CellFinder finder(map);
  const float low_m = obstacle_height_m(vehicle);
  const float high_m = static_cast<float>(vehicle.height_m) + kRoofM;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const int at = is_usable(p) ? finder.at(p.x(), p.y()) : CellFinder::kOutside;
      if (at == CellFinder::kOutside) continue;
      TerrainCell& cell = map.cells[static_cast<std::size_t>(at)];
      const float above_m = p.z() - cell.low_m;  // NaN without ground
      if (cell.ground != Ground::kObserved || !(above_m > low_m && above_m < high_m)) continue;
      const Eigen::Vector2d share = (p.head<2>().cast<double>() - map.p_level_corner) / map.cell_m -
                                    map.cells.cell(static_cast<std::size_t>(at)).cast<double>();
      cell.obstacle_parts |= CellParts::bit_at(share.x(), share.y());
    }
  }
}

}  // namespace adit
