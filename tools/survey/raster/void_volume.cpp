// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/raster/void_volume.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <deque>

namespace adit {
namespace {

const std::array<Eigen::Vector2i, 4> kAlongAxes{Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1),
                                                Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, -1)};

constexpr double kFilledSdShare = 0.1;  // standard deviation of what was filled, as a share of it

bool is_complete(const SurveyColumn& column) {
  return column.kind == SurveyColumn::Kind::kVoid && std::isfinite(column.height_m());
}

/// Whether a column is void without a complete floor and roof.
bool is_gap(const SurveyColumn& column, const Eigen::Vector2d& p_survey,
            const OccupancyGrid* free_space) {
  if (column.kind == SurveyColumn::Kind::kVoid) return !is_complete(column);
  if (column.kind == SurveyColumn::Kind::kWall || free_space == nullptr) return false;
  return free_space->state(free_space->cell_at(p_survey)) == CellState::kFree;
}

/// The height of the nearest void column of each cell of wall beside void; 0 elsewhere.
Grid2<float> heights_beside_walls(const Grid2<SurveyColumn>& columns, int reach) {
  Grid2<float> heights(columns.box());
  Grid2<std::uint8_t> steps(columns.box());
  std::deque<std::size_t> open;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!is_complete(columns[i])) continue;
    heights[i] = columns[i].height_m();
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t i = open.front();
    open.pop_front();
    if (steps[i] >= reach) continue;
    for (const Eigen::Vector2i& step : kAlongAxes) {
      const Eigen::Vector2i next = columns.cell(i) + step;
      if (!columns.contains(next) || heights.at(next) > 0.0F) continue;
      if (columns.at(next).kind != SurveyColumn::Kind::kWall) continue;
      heights.at(next) = heights[i];
      steps.at(next) = static_cast<std::uint8_t>(steps[i] + 1);
      open.push_back(columns.index(next));
    }
  }
  return heights;
}

}  // namespace

ColumnGrid with_gaps_filled(const ColumnGrid& grid, const OccupancyGrid* free_space,
                            const VoidVolumeParams& params) {
  ColumnGrid filled = grid;
  const int reach = static_cast<int>(std::round(params.fill_max_m / grid.cell_m));
  Grid2<std::uint8_t> steps(grid.columns.box());
  std::deque<std::size_t> open;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (is_complete(grid.columns[i])) open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t i = open.front();
    open.pop_front();
    if (steps[i] >= reach) continue;
    for (const Eigen::Vector2i& step : kAlongAxes) {
      const Eigen::Vector2i next = grid.columns.cell(i) + step;
      if (!filled.columns.contains(next) || is_complete(filled.columns.at(next))) continue;
      SurveyColumn& column = filled.columns.at(next);
      if (!is_gap(column, centre_of(next, grid.cell_m), free_space)) continue;
      column.kind = SurveyColumn::Kind::kVoid;
      if (!std::isfinite(column.floor_m)) column.floor_m = filled.columns[i].floor_m;
      if (!std::isfinite(column.roof_m)) column.roof_m = filled.columns[i].roof_m;
      steps.at(next) = static_cast<std::uint8_t>(steps[i] + 1);
      open.push_back(filled.columns.index(next));
    }
  }
  return filled;
}

VoidVolume void_volume(const ColumnGrid& grid, const ColumnGrid& filled,
                       const VoidVolumeParams& params) {
  const int reach = static_cast<int>(std::round(params.wall_max_m / grid.cell_m));
  const Grid2<float> heights = heights_beside_walls(filled.columns, reach);
  const double cell_m2 = grid.cell_m * grid.cell_m;
  VoidVolume sum;
  double scatter_m6 = 0.0;
  double filled_m3 = 0.0;
  double wall_m2 = 0.0;    // of the outline, seen from the side
  double outline_m = 0.0;  // in plan
  for (std::size_t i = 0; i < filled.columns.size(); ++i) {
    const SurveyColumn& column = filled.columns[i];
    const double height_m = heights[i];
    if (height_m <= 0.0) continue;
    const double share = is_complete(column) ? 1.0 : 0.5;
    sum.area_m2.value += share * cell_m2;
    sum.volume_m3.value += share * cell_m2 * height_m;
    if (share < 1.0) {
      outline_m += 0.5 * grid.cell_m;
      wall_m2 += 0.5 * grid.cell_m * height_m;
      scatter_m6 += std::pow(0.5 * cell_m2 * height_m, 2);
    } else if (is_complete(grid.columns[i])) {
      scatter_m6 += std::pow(cell_m2, 2) *
                    (std::pow(params.common_sd_m, 2) + std::pow(params.common_sd_m, 2));
    } else {
      sum.filled_m2 += cell_m2;
      filled_m3 += cell_m2 * height_m;
    }
  }
  const double surface_m2 = 2.0 * sum.area_m2.value + wall_m2;
  sum.area_m2.sd = std::hypot(outline_m * params.common_sd_m, kFilledSdShare * sum.filled_m2,
                              0.5 * grid.cell_m * std::sqrt(outline_m * grid.cell_m));
  sum.volume_m3.sd = std::sqrt(std::pow(surface_m2 * params.common_sd_m, 2) +
                               std::pow(kFilledSdShare * filled_m3, 2) + scatter_m6);
  return sum;
}

}  // namespace adit
