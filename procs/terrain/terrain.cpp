// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "procs/terrain/derived_layers.hpp"
#include "procs/terrain/ground_level.hpp"
#include "procs/terrain/obstacle_parts.hpp"
#include "procs/terrain/region_heights.hpp"
#include "procs/terrain/visibility/passing_beams.hpp"
#include "procs/terrain/visibility/unseen_ground.hpp"

namespace adit {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kContinuousM = 0.05F;   // noise of the heights of one surface
constexpr double kBetweenLinesM = 0.5;  // between the lines of a scan on it

template <class Visit>
void for_each_cell(const TerrainMap& map, const Visit& visit) {
  std::size_t i = 0;
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) visit(column, row, i++);
  }
}

/// Marks what continues regions that hang over the ground away from the laser: at the far end of a
/// roof no beam passes below it. What lies below a roof itself does not: walls and banks lead from
/// the roof down to the floor without a gap.
void mark_continued(std::vector<std::uint8_t>& hanging, const std::vector<float>& low_m,
                    const std::vector<std::uint8_t>& below_roof, const TerrainMap& map,
                    const Eigen::Vector2d& p_level_laser) {
  const auto distance_m = [&](const Eigen::Vector2i& at) {
    return (map.centre(at.x(), at.y()) - p_level_laser).norm();
  };
  const auto reach = static_cast<int>(std::lround(kBetweenLinesM / map.cell_m));
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < hanging.size(); ++i) {
    if (hanging[i] != 0) front.push_back(i);
  }
  while (!front.empty()) {
    const std::size_t from = front.back();
    front.pop_back();
    const Eigen::Vector2i at = map.cells.cell(from);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Eigen::Vector2i next = at + Eigen::Vector2i(dx, dy);
        if (!map.cells.contains(next)) continue;
        const std::size_t i = map.cells.index(next);
        if (hanging[i] != 0 || below_roof[i] != 0) continue;
        if (distance_m(next) <= distance_m(at)) continue;
        const float gap_m = static_cast<float>(map.cell_m) * std::hypot(dx, dy);
        const float rise_m = std::abs(low_m[i] - low_m[from]);
        if (!(rise_m <= kContinuousM + GroundTrend::kGradeMax * gap_m)) continue;  // or NaN
        hanging[i] = 1;
        front.push_back(i);
      }
    }
  }
}

/// What each region shows of its ground. Points with beams below them hang over it.
RegionGround region_ground(const RegionHeights& regions, const TerrainMap& map,
                           const PassingBeams& beams, double step_max_m) {
  RegionGround ground{std::vector<float>(map.cells.size()),
                      std::vector<std::uint8_t>(map.cells.size(), 0)};
  std::vector<std::uint8_t> hanging(map.cells.size());
  std::vector<std::uint8_t> below_roof(map.cells.size());
  for_each_cell(map, [&](int column, int row, std::size_t i) {
    const float low_m = regions.low_m(column, row);
    const RegionHeights::Above above = regions.above(column, row, low_m);
    ground.low_m[i] = low_m;
    ground.steep[i] = above.high_m - low_m > static_cast<float>(step_max_m) ? 1 : 0;
    below_roof[i] = std::isfinite(above.roof_m) ? 1 : 0;
    hanging[i] = beams.pass_below(map.centre(column, row).cast<float>(), low_m) ? 1 : 0;
  });
  mark_continued(hanging, ground.low_m, below_roof, map, beams.p_level_laser());
  for (std::size_t i = 0; i < hanging.size(); ++i) {
    if (hanging[i] != 0) ground.low_m[i] = kUnknown;
  }
  return ground;
}

/// A cell with an obstacle within the headroom is observed even if its ground is not, but only if
/// passable ground cannot lie so low that the vehicle fits under the obstacle. A cell that shows
/// only the roof, or what may be the roof, is not observed.
void set_heights(TerrainMap& map, const RegionHeights& regions, const GroundLevel& ground) {
  for_each_cell(map, [&](int column, int row, std::size_t i) {
    RegionHeights::Above above = regions.above(column, row, ground.least_m(i));
    if (above.count > 0 && !ground.is_observed(i))
      above = regions.above(column, row, ground.low_m(i));
    TerrainCell& cell = map.cells[i];
    cell.clearance_m =
        above.roof_m;  // the height of the roof, until set_differences subtracts the ground
    if (above.count == 0) return;
    cell.ground = Ground::kObserved;
    cell.count = static_cast<std::uint16_t>(std::min<std::uint32_t>(above.count, UINT16_MAX));
    cell.low_m = ground.low_m(i);
    cell.high_m = above.high_m;
  });
}

/// Where the floor is seen but not what is above it within the headroom: behind the lip of a low
/// roof or a beam, which hides it.
void set_hidden_headroom(TerrainMap& map, const PassingBeams& beams, double headroom_m) {
  const auto least_m = static_cast<float>(headroom_m);
  for_each_cell(map, [&](int column, int row, std::size_t i) {
    TerrainCell& cell = map.cells[i];
    if (cell.ground != Ground::kObserved || !std::isinf(cell.clearance_m)) return;
    const float free_m = beams.free_up_to_m(map.centre(column, row).cast<float>());
    if (free_m < cell.low_m + least_m) cell.clearance_m = kUnknown;
  });
}

void set_differences(TerrainMap& map) {
  for (TerrainCell& cell : map.cells) {
    cell.coefficient_m = cell.high_m - cell.low_m;
    cell.clearance_m = cell.clearance_m - cell.low_m;
  }
}

/// Whether the rear laser made the scan, that is, whether most lines begin behind the origin.
bool is_rear_scan(const Cloud& cloud) {
  std::size_t behind = 0;
  for (const CloudLine& line : cloud.lines) behind += line.origin.x() < 0.0F ? 1 : 0;
  return 2 * behind > cloud.lines.size();
}

}  // namespace

TerrainMap Terrain::make(const Cloud& cloud) const {
  TerrainMap map = heights(cloud);
  derive_layers(map);
  return map;
}

TerrainMap Terrain::make(const Cloud& cloud, TerrainMemory& memory) const {
  TerrainMap map = heights(cloud);
  memory.recall(map);
  derive_layers(map);
  return map;
}

TerrainMap Terrain::heights(const Cloud& cloud) const {
  TerrainMap map = blank(cloud);
  const CellHeights heights(cloud, map);
  const RegionHeights regions(heights, map, params_);
  const PassingBeams beams(cloud, map, params_.vehicle.step_max_m);
  const RegionGround observed = region_ground(regions, map, beams, params_.vehicle.step_max_m);
  const GroundLevel ground(map, observed, heights.trend(), params_);
  set_heights(map, regions, ground);
  classify_unseen_ground(map, cloud, heights, ground, beams, params_);
  set_hidden_headroom(map, beams, params_.headroom_m());
  set_obstacle_parts(map, cloud, params_.vehicle);
  return map;
}

void Terrain::derive_layers(TerrainMap& map) const {
  set_differences(map);
  set_slope_and_step(map);
  set_repulsion(map, params_.repulsion);
}

TerrainMap Terrain::blank(const Cloud& cloud) const {
  const auto cells = [&](double metres) {
    return static_cast<int>(std::lround(metres / params_.cell_m));
  };
  TerrainMap map;
  map.utime = cloud.utime;
  map.id = cloud.id;
  map.T_odom_level = cloud.T_odom_level;
  map.cell_m = params_.cell_m;
  TerrainCell unknown;
  unknown.low_m = kUnknown;
  unknown.high_m = kUnknown;
  map.cells = Grid2<TerrainCell>(std::max(cells(params_.length_m), 1),
                                 std::max(cells(params_.width_m), 1), unknown);
  // The vehicle stands at the centre of a cell, so that a path can begin at its pose.
  const int behind_cells = cells(params_.behind_m);
  const int behind = is_rear_scan(cloud) ? map.cells.columns() - 1 - behind_cells : behind_cells;
  const int beside = map.cells.rows() / 2;
  map.p_level_corner = -map.cell_m * Eigen::Vector2d(behind + 0.5, beside + 0.5);
  return map;
}

}  // namespace adit
