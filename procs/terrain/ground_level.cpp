// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/ground_level.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int32_t kNotYet = -1;

}  // namespace

GroundLevel::GroundLevel(const TerrainMap& map, const std::vector<float>& low_m,
                         const TerrainParams& params)
    : low_m_(low_m),
      step_m_(static_cast<float>(params.vehicle.step_max_m)),
      rise_m_(static_cast<float>(params.unseen.grade_max * map.cell_m)),
      level_m_(map.cells.size(), 0.0F),
      unseen_(map.cells.size(), kNotYet),
      seen_(map.cells.size(), 0) {
  queue_.reserve(map.cells.size());
  start_below_vehicle(map, params.vehicle);
  const auto columns = static_cast<std::size_t>(map.columns);
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const std::size_t cell = queue_[i];
    const std::size_t column = cell % columns;
    if (column > 0) visit(cell - 1, cell);
    if (column + 1 < columns) visit(cell + 1, cell);
    if (cell >= columns) visit(cell - columns, cell);
    if (cell + columns < map.cells.size()) visit(cell + columns, cell);
  }
}

/// The cells of the footprint; the nearest one where the map does not reach that far.
void GroundLevel::start_below_vehicle(const TerrainMap& map, const Vehicle& vehicle) {
  const auto range = [&](double half_m, double corner_m, int cells) {
    const auto cell = [&](double at_m) {
      return std::clamp(static_cast<int>(std::floor((at_m - corner_m) / map.cell_m)), 0, cells - 1);
    };
    return std::pair(cell(-half_m), cell(half_m));
  };
  const auto columns = range(vehicle.length_m / 2.0, map.p_level_corner.x(), map.columns);
  const auto rows = range(vehicle.width_m / 2.0, map.p_level_corner.y(), map.rows);
  for (int row = rows.first; row <= rows.second; ++row) {
    for (int column = columns.first; column <= columns.second; ++column) {
      const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                        static_cast<std::size_t>(column);
      unseen_[cell] = 0;
      seen_[cell] = low_m_[cell] <= step_m_ ? 1 : 0;
      queue_.push_back(cell);
    }
  }
}

void GroundLevel::visit(std::size_t cell, std::size_t from) {
  if (unseen_[cell] != kNotYet) return;
  queue_.push_back(cell);
  const float level = level_m_[from];
  const float low = low_m_[cell];
  seen_[cell] = low <= level + step_m_ + rise_m_ * static_cast<float>(unseen_[from]) ? 1 : 0;
  // Behind a pit the ground is to be expected where it was before it.
  const bool goes_on = seen_[cell] != 0 && low >= level - step_m_;
  level_m_[cell] = goes_on ? low : level;
  unseen_[cell] = goes_on ? 0 : unseen_[from] + 1;
}

}  // namespace adit
