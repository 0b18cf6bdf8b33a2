// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/ground_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr std::size_t kNotYet = std::numeric_limits<std::size_t>::max();
constexpr float kNoise = 0.03F;  // of the lowest heights of neighbours [m]

}  // namespace

GroundLevel::GroundLevel(const TerrainMap& map, const std::vector<float>& low_m,
                         const TerrainParams& params)
    : low_m_(low_m),
      step_m_(static_cast<float>(params.vehicle.step_max_m)),
      rise_m_(static_cast<float>(params.unseen.grade_max * map.cell_m)),
      level_m_(map.cells.size(), 0.0F),
      unseen_(map.cells.size(), kNotYet),
      seen_(map.cells.size(), 0) {
  start_below_vehicle(map, params.vehicle);
  spread(static_cast<std::size_t>(map.columns));
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
      seen_[cell] = low_m_[cell] <= step_m_ ? 1 : 0;
      enter(cell, 0.0F, 0);
    }
  }
}

void GroundLevel::enter(std::size_t cell, float level_m, std::size_t unseen) {
  level_m_[cell] = level_m;
  unseen_[cell] = unseen;
  if (queues_.size() <= unseen) queues_.resize(unseen + 1);
  queues_[unseen].push_back(cell);
}

/// As Dijkstra's algorithm does, with the cells since the ground was seen as the way.
void GroundLevel::spread(std::size_t columns) {
  std::vector<std::size_t> batch;
  for (std::size_t unseen = 0; unseen < queues_.size();) {
    batch.clear();
    batch.swap(queues_[unseen]);
    for (const std::size_t cell : batch) {
      if (unseen_[cell] == unseen) visit_neighbours(cell, columns);
    }
    const bool ground_again = !queues_.front().empty();
    unseen = ground_again ? 0 : unseen + 1;
  }
}

void GroundLevel::visit_neighbours(std::size_t cell, std::size_t columns) {
  const std::size_t column = cell % columns;
  if (column > 0) visit(cell - 1, cell);
  if (column + 1 < columns) visit(cell + 1, cell);
  if (cell >= columns) visit(cell - columns, cell);
  if (cell + columns < level_m_.size()) visit(cell + columns, cell);
}

void GroundLevel::visit(std::size_t cell, std::size_t from) {
  if (unseen_[cell] == 0) return;
  const float level = level_m_[from];
  const float low = low_m_[cell];
  const float rise = rise_m_ * static_cast<float>(unseen_[from] + 1);
  if (low <= level + rise + kNoise && low >= level - step_m_) {
    seen_[cell] = 1;
    enter(cell, low, 0);
  } else if (unseen_[from] + 1 < unseen_[cell]) {
    // Behind a pit, a stone or a wall the ground is to be expected where it was before it.
    seen_[cell] = low < level ? 1 : 0;
    enter(cell, level, unseen_[from] + 1);
  }
}

}  // namespace adit
