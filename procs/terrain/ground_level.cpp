// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/ground_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr std::size_t kNotYet = std::numeric_limits<std::size_t>::max();
constexpr float kNoise = 0.03F;  // noise of the lowest heights of neighbours [m]

}  // namespace

GroundLevel::GroundLevel(const TerrainMap& map, const RegionGround& regions,
                         const GroundTrend& trend, const TerrainParams& params)
    : low_m_(regions.low_m),
      steep_(regions.steep),
      trend_(trend),
      step_m_(static_cast<float>(params.vehicle.step_max_m)),
      rise_m_(static_cast<float>(params.unseen.grade_max * map.cell_m)),
      fall_m_(GroundTrend::kGradeMax * static_cast<float>(map.cell_m)),
      level_m_(map.cells.size(), 0.0F),
      unobserved_(map.cells.size(), kNotYet),
      observed_(map.cells.size(), 0) {
  start_below_vehicle(map, params.vehicle);
  spread(static_cast<std::size_t>(map.cells.columns()));
}

/// Starts with the cells of the footprint, or the nearest cells where the map does not extend to
/// it.
void GroundLevel::start_below_vehicle(const TerrainMap& map, const Vehicle& vehicle) {
  const auto range = [&](double half_m, double corner_m, int cells) {
    const auto cell = [&](double at_m) {
      return std::clamp(static_cast<int>(std::floor((at_m - corner_m) / map.cell_m)), 0, cells - 1);
    };
    return std::pair(cell(-half_m), cell(half_m));
  };
  const auto columns = range(vehicle.length_m / 2.0, map.p_level_corner.x(), map.cells.columns());
  const auto rows = range(vehicle.width_m / 2.0, map.p_level_corner.y(), map.cells.rows());
  const Eigen::Vector2i middle((columns.first + columns.second) / 2,
                               (rows.first + rows.second) / 2);
  const Eigen::Vector2f& rise_m = trend_.rise_m(middle.x(), middle.y());
  const auto cells_per_m = static_cast<float>(1.0 / map.cell_m);
  for (int row = rows.first; row <= rows.second; ++row) {
    for (int column = columns.first; column <= columns.second; ++column) {
      const std::size_t cell = map.cells.index({column, row});
      const float level = cells_per_m * rise_m.dot(map.centre(column, row).cast<float>());
      observed_[cell] = low_m_[cell] <= level + step_m_ ? 1 : 0;
      enter(cell, level, 0);
    }
  }
}

void GroundLevel::enter(std::size_t cell, float level_m, std::size_t unobserved) {
  level_m_[cell] = level_m;
  unobserved_[cell] = unobserved;
  if (queues_.size() <= unobserved) queues_.resize(unobserved + 1);
  queues_[unobserved].push_back(cell);
}

/// Dijkstra's algorithm with the number of cells since the last observed ground as the distance.
void GroundLevel::spread(std::size_t columns) {
  std::vector<std::size_t> batch;
  for (std::size_t unobserved = 0; unobserved < queues_.size();) {
    batch.clear();
    batch.swap(queues_[unobserved]);
    for (const std::size_t cell : batch) {
      if (unobserved_[cell] == unobserved) visit_neighbours(cell, columns);
    }
    const bool has_observed_ground = !queues_.front().empty();
    unobserved = has_observed_ground ? 0 : unobserved + 1;
  }
}

void GroundLevel::visit_neighbours(std::size_t cell, std::size_t columns) {
  const std::size_t column = cell % columns;
  if (column > 0) visit(cell - 1, cell, {-1.0F, 0.0F});
  if (column + 1 < columns) visit(cell + 1, cell, {1.0F, 0.0F});
  if (cell >= columns) visit(cell - columns, cell, {0.0F, -1.0F});
  if (cell + columns < level_m_.size()) visit(cell + columns, cell, {0.0F, 1.0F});
}

void GroundLevel::visit(std::size_t cell, std::size_t from, const Eigen::Vector2f& ahead) {
  if (unobserved_[cell] == 0) return;
  const float level = level_m_[from] + trend_.rise_m(cell).dot(ahead);
  const float low = low_m_[cell];
  const std::size_t unobserved = unobserved_[from] + 1;
  const float rise = rise_m_ * static_cast<float>(unobserved);
  const bool is_steep = steep_[cell] != 0;
  const float above = is_steep ? std::min(rise, step_m_) : rise;
  const bool is_ground = low <= level + above + kNoise && low >= level - step_m_;
  if (is_ground && !is_steep) {
    observed_[cell] = 1;
    enter(cell, low, 0);
  } else if (unobserved < unobserved_[cell]) {
    // Behind a pit, a rock or a wall the ground is expected to continue that in front.
    observed_[cell] = is_ground || low < level ? 1 : 0;
    enter(cell, is_ground ? low : level, unobserved);
  }
}

}  // namespace adit
