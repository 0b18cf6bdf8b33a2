// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/guide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace adit {
namespace {

constexpr double kMiddleCost =
    4.0;  // of a metre of cells at the walls, more than one in the middle
constexpr double kProgressGain = 8.0;  // of a metre of progress, for that of the farthest cell

double most_progress_m(const TerrainMap& terrain, const GoalField& goals) {
  double most_m = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < terrain.cells.size(); ++i)
    most_m = std::max(most_m, goals.progress(i));
  return most_m;
}

}  // namespace

Guide::Guide(const TerrainMap& terrain, const WallDistance& walls, const GoalField& goals,
             const Vehicle& vehicle)
    : terrain_(terrain),
      walls_(walls),
      goals_(goals),
      // A cell is up to half its diagonal beside the middle.
      free_m_(vehicle.width_m / 2.0 - terrain.cell_m / std::numbers::sqrt2),
      costs_(terrain.cells.size(), std::numeric_limits<double>::infinity()),
      from_(terrain.cells.size(), terrain.cells.size()) {}

Polyline Guide::to_most_progress(const Eigen::Vector2d& p_level_body) {
  const Eigen::Vector2i start = terrain_.cell_at(p_level_body);
  if (!terrain_.cells.contains(start)) return {};
  Polyline line;
  for (std::size_t i = search(terrain_.cells.index(start)); i < costs_.size(); i = from_[i]) {
    const Eigen::Vector2i at = terrain_.cells.cell(i);
    line.push_back(terrain_.centre(at.x(), at.y()));
  }
  line.back() = p_level_body;
  std::ranges::reverse(line);
  return line;
}

double Guide::gain(std::size_t cell) const {
  return kProgressGain * goals_.progress(cell) - terrain_.cell_m * costs_[cell];
}

/// Returns the cell with the largest gain. Ends as soon as no farther cell can have a larger one.
std::size_t Guide::search(std::size_t start) {
  const double progress_gain_max = kProgressGain * most_progress_m(terrain_, goals_);
  std::size_t best = start;
  costs_[start] = 0.0;
  open_.emplace(0.0, start);
  while (!open_.empty()) {
    const auto [cost, cell] = open_.top();
    open_.pop();
    if (cost > costs_[cell]) continue;
    if (progress_gain_max - terrain_.cell_m * cost < gain(best)) break;
    if (gain(cell) > gain(best)) best = cell;
    expand(cell);
  }
  return best;
}

void Guide::expand(std::size_t cell) {
  const Eigen::Vector2i at = terrain_.cells.cell(cell);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      reach(at + Eigen::Vector2i(dx, dy), cell, std::hypot(dx, dy));
    }
  }
}

/// Reaches a neighbour, `step` cells away, if the body may be there and that costs less than
/// before.
void Guide::reach(const Eigen::Vector2i& at, std::size_t from, double step) {
  if (!terrain_.cells.contains(at)) return;
  const double distance_m = walls_.at(terrain_.centre(at.x(), at.y()));
  if (distance_m < free_m_) return;
  const double near = std::clamp(1.0 - (distance_m - free_m_) / WallDistance::kSideMaxM, 0.0, 1.0);
  const double cost = costs_[from] + step * (1.0 + kMiddleCost * near);
  const std::size_t cell = terrain_.cells.index(at);
  if (cost >= costs_[cell]) return;
  costs_[cell] = cost;
  from_[cell] = from;
  open_.emplace(cost, cell);
}

}  // namespace adit
