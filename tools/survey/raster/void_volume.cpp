// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/raster/void_volume.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "common/geometry/order_statistics.hpp"

namespace adit {
namespace {

const std::array<Eigen::Vector2i, 4> kAlongAxes{Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1),
                                                Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, -1)};

bool is_complete(const SurveyColumn& column) {
  return column.kind == SurveyColumn::Kind::kVoid && std::isfinite(column.height_m());
}

/// The first complete column from a cell along an axis, before any wall; null if there is none
/// within `reach` cells.
const SurveyColumn* void_beside(const Grid2<SurveyColumn>& columns, const Eigen::Vector2i& cell,
                                const Eigen::Vector2i& step, int reach) {
  for (int i = 1; i <= reach; ++i) {
    const Eigen::Vector2i at = cell + i * step;
    if (!columns.contains(at) || columns.at(at).kind == SurveyColumn::Kind::kWall) return nullptr;
    if (is_complete(columns.at(at))) return &columns.at(at);
  }
  return nullptr;
}

/// A column between void columns, three of the four along the axes.
std::optional<SurveyColumn> interpolated(const Grid2<SurveyColumn>& columns,
                                         const Eigen::Vector2i& cell, int reach) {
  std::vector<double> floors;
  std::vector<double> roofs;
  for (const Eigen::Vector2i& step : kAlongAxes) {
    const SurveyColumn* const beside = void_beside(columns, cell, step, reach);
    if (beside == nullptr) continue;
    floors.push_back(beside->floor_m);
    roofs.push_back(beside->roof_m);
  }
  if (floors.size() < 3) return std::nullopt;
  SurveyColumn column = columns.at(cell);
  column.kind = SurveyColumn::Kind::kVoid;
  if (!std::isfinite(column.floor_m)) column.floor_m = static_cast<float>(median(floors));
  if (!std::isfinite(column.roof_m)) column.roof_m = static_cast<float>(median(roofs));
  return column;
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

ColumnGrid with_holes_filled(const ColumnGrid& grid, const VoidVolumeParams& params) {
  ColumnGrid filled = grid;
  const int reach = static_cast<int>(std::round(params.hole_max_m / grid.cell_m));
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const SurveyColumn& column = grid.columns[i];
    if (column.kind == SurveyColumn::Kind::kWall || is_complete(column)) continue;
    if (const auto between = interpolated(grid.columns, grid.columns.cell(i), reach))
      filled.columns[i] = *between;
  }
  return filled;
}

VoidVolume void_volume(const ColumnGrid& grid, const VoidVolumeParams& params) {
  const ColumnGrid filled = with_holes_filled(grid, params);
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
  sum.area_m2.sd = std::hypot(outline_m * params.common_sd_m, 0.5 * sum.filled_m2,
                              0.5 * grid.cell_m * std::sqrt(outline_m * grid.cell_m));
  sum.volume_m3.sd = std::sqrt(std::pow(surface_m2 * params.common_sd_m, 2) +
                               std::pow(0.5 * filled_m3, 2) + scatter_m6);
  return sum;
}

}  // namespace adit
