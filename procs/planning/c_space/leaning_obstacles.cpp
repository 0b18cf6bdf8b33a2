// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/leaning_obstacles.hpp"

#include <limits>

namespace adit {
namespace {

GroundTrend trend_of(const TerrainMap& terrain) {
  Grid2<float> low_m(terrain.cells.box(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    if (terrain.cells[i].ground == Ground::kObserved) low_m[i] = terrain.cells[i].low_m;
  }
  return {low_m, terrain.cell_m};
}

}  // namespace

LeaningObstacles::LeaningObstacles(const TerrainMap& terrain)
    : trend_(trend_of(terrain)), cell_m_(terrain.cell_m) {}

Eigen::Vector2d LeaningObstacles::displacement_m(int column, int row, double height_m) const {
  const Eigen::Vector2d grade = trend_.rise_m(column, row).cast<double>() / cell_m_;
  return height_m / (1.0 + grade.squaredNorm()) * grade;
}

}  // namespace adit
