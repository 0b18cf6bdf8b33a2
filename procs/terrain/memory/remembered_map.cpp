// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/remembered_map.hpp"

#include <utility>

namespace adit {

Eigen::Isometry2d motion_of(const Pose2& T_a_b) {
  return Eigen::Translation2d(T_a_b.x, T_a_b.y) * Eigen::Rotation2Dd(T_a_b.theta);
}

RememberedMap::RememberedMap(const TerrainMap& map, double distance_travelled_m)
    : finder_(map),
      p_level_corner_(map.p_level_corner),
      cell_m_(map.cell_m),
      T_odom_level_(map.T_odom_level),
      distance_travelled_m_(distance_travelled_m),
      columns_(map.cells.columns()),
      cells_(map.cells.box()) {
  for (int row = 0; row < map.cells.rows(); ++row) {
    for (int column = 0; column < map.cells.columns(); ++column) {
      const TerrainCell& cell = map.cells.at({column, row});
      const Ground ground = is_narrow_gap(map, column, row) ? Ground::kNeverObserved : cell.ground;
      cells_.at({column, row}) = {cell.low_m, cell.high_m, cell.clearance_m,   cell.count,
                                  ground,     false,       cell.obstacle_parts};
    }
  }
}

void RememberedMap::crop() {
  CellBox informative;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].is_informative()) informative = united(informative, cells_.cell(i));
  }
  Grid2<RememberedCell> cropped(informative);
  for (std::size_t i = 0; i < cropped.size(); ++i) cropped[i] = cells_.at(cropped.cell(i));
  cells_ = std::move(cropped);
}

bool RememberedMap::has_obstacle_at(const Eigen::Vector2d& p_level) const {
  const RememberedCell* cell = at(static_cast<float>(p_level.x()), static_cast<float>(p_level.y()));
  if (cell == nullptr || cell->ground != Ground::kObserved) return false;
  const Eigen::Vector2d cells = (p_level - p_level_corner_) / cell_m_;
  const Eigen::Vector2d share = cells - cells.array().floor().matrix();
  return (cell->obstacle_parts & CellParts::bit_at(share.x(), share.y())) != 0;
}

namespace {

constexpr int kDropAround = 3;  // open cells of the four neighbours that make a drop
constexpr int kEvenAround = 5;  // even cells of the eight neighbours that close a gap

}  // namespace

bool is_narrow_gap(const TerrainMap& map, int column, int row) {
  if (map.cells.at({column, row}).ground != Ground::kBelowRay) return false;
  int around = 0;
  const auto count_open = [&](int c, int r) {
    if (!map.cells.contains({c, r})) return;
    const Ground ground = map.cells.at({c, r}).ground;
    if (ground == Ground::kBelowRay || ground == Ground::kNoReturn) ++around;
  };
  for (const int step : {-1, 1}) {
    count_open(column + step, row);
    count_open(column, row + step);
  }
  return around < kDropAround;
}

void close_narrow_gaps(TerrainMap& map, const std::vector<std::uint8_t>& changed,
                       float obstacle_m) {
  std::vector<std::pair<std::size_t, float>>
      closed;  // applied at the end: closed cells do not close others
  for (int row = 1; row + 1 < map.cells.rows(); ++row) {
    for (int column = 1; column + 1 < map.cells.columns(); ++column) {
      const std::size_t i = map.cells.index({column, row});
      if (!is_unknown(map.cells[i]) || changed[i] != 0) continue;
      int even = 0;
      float sum = 0.0F;
      for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = column - 1; c <= column + 1; ++c) {
          const TerrainCell& cell = map.cells.at({c, r});
          if (cell.ground != Ground::kObserved || cell.high_m - cell.low_m > obstacle_m) continue;
          ++even;
          sum += cell.low_m;
        }
      }
      if (even >= kEvenAround) closed.emplace_back(i, sum / static_cast<float>(even));
    }
  }
  for (const auto& [i, z_m] : closed) {
    map.cells[i].ground = Ground::kObserved;
    map.cells[i].low_m = map.cells[i].high_m = z_m;
  }
}

}  // namespace adit
