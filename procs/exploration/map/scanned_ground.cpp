// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/scanned_ground.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr float kObstacleM = 0.3F;  // higher: not ground
constexpr float kRockM = 0.6F;   // higher: rock; the terrain counts obstacles up to the height of
                                 // the vehicle
constexpr int kGroundReach = 2;  // cells of ground to each side of a cell that counts as ground
constexpr int kCellsMax = 1'000'000;

/// Classes of single cells of the terrain, the worst of those within each coarser cell.
struct Summary {
  bool rock = false;
  bool obstacle = false;
  bool not_ground = false;
  bool observed = false;
};

bool is_ground(const TerrainCell& cell, double vehicle_height_m) {
  return cell.ground == Ground::kObserved && cell.coefficient_m < kObstacleM &&
         vehicle_height_m < static_cast<double>(cell.clearance_m);
}

bool is_rock(const TerrainCell& cell) {
  return cell.ground == Ground::kObserved && cell.coefficient_m >= kRockM;
}

/// Neither the wheels nor the belly pass over it.
bool is_obstacle(const TerrainCell& cell, const Vehicle& vehicle) {
  const double limit_m = std::min(vehicle.step_max_m, vehicle.belly_clearance_m);
  return cell.ground == Ground::kObserved && cell.coefficient_m > static_cast<float>(limit_m);
}

Grid2<Summary> summarise(const TerrainMap& terrain, double resolution_m, const Vehicle& vehicle) {
  const Eigen::Vector2d extent =
      terrain.cell_m * Eigen::Vector2d(terrain.cells.columns(), terrain.cells.rows());
  Grid2<Summary> summaries(
      CellBox{cell_of(terrain.p_level_corner, resolution_m),
              cell_of(terrain.p_level_corner + extent, resolution_m) + Eigen::Vector2i(1, 1)});
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const TerrainCell& cell = terrain.cells[i];
    const Eigen::Vector2i at = terrain.cells.cell(i);
    const Eigen::Vector2i coarse = cell_of(terrain.centre(at.x(), at.y()), resolution_m);
    if (!summaries.contains(coarse)) continue;
    Summary& summary = summaries.at(coarse);
    summary.observed |= cell.ground == Ground::kObserved;
    summary.rock |= is_rock(cell);
    summary.obstacle |= is_obstacle(cell, vehicle);
    summary.not_ground |= !is_ground(cell, vehicle.height_m);
  }
  return summaries;
}

bool is_ground_around(const Grid2<Summary>& summaries, const Eigen::Vector2i& cell) {
  for (int y = -kGroundReach; y <= kGroundReach; ++y) {
    for (int x = -kGroundReach; x <= kGroundReach; ++x) {
      const Summary summary = summaries.get(cell + Eigen::Vector2i(x, y));
      if (!summary.observed || summary.not_ground) return false;
    }
  }
  return true;
}

}  // namespace

Grid2<ScannedCell> scanned_cells(const TerrainMap& terrain, double resolution_m,
                                 const Vehicle& vehicle) {
  const Grid2<Summary> summaries = summarise(terrain, resolution_m, vehicle);
  Grid2<ScannedCell> cells(summaries.box());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (summaries[i].rock) {
      cells[i] = ScannedCell::kRock;
    } else if (summaries[i].obstacle) {
      cells[i] = ScannedCell::kObstacle;
    } else if (is_ground_around(summaries, summaries.cell(i))) {
      cells[i] = ScannedCell::kGround;
    }
  }
  return cells;
}

std::string to_text(const ScannedGround& ground) {
  const CellBox& box = ground.cells.box();
  std::string text =
      fmt::format("{} {:.17g} {:.17g} {:.17g} {} {} {} {} ", ground.local_map,
                  ground.T_local_level.x, ground.T_local_level.y, ground.T_local_level.theta,
                  box.from.x(), box.from.y(), box.to.x(), box.to.y());
  for (const ScannedCell cell : ground.cells) {
    text += static_cast<char>('0' + static_cast<int>(cell));
  }
  return text + '\n';
}

std::optional<ScannedGround> scanned_ground_from_text(std::string_view text) {
  std::istringstream in{std::string(text)};
  ScannedGround ground;
  CellBox box;
  std::string cells;
  in >> ground.local_map >> ground.T_local_level.x >> ground.T_local_level.y >>
      ground.T_local_level.theta >> box.from.x() >> box.from.y() >> box.to.x() >> box.to.y() >>
      cells;
  const bool valid = in && ground.local_map >= 0 && ground.T_local_level.vector().allFinite() &&
                     !box.empty() && (box.size().array() < kCellsMax).all() &&
                     box.count() == cells.size();
  if (!valid) return std::nullopt;
  ground.cells = Grid2<ScannedCell>(box);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] < '0' || cells[i] > '3') return std::nullopt;
    ground.cells[i] = static_cast<ScannedCell>(cells[i] - '0');
  }
  return ground;
}

}  // namespace adit
