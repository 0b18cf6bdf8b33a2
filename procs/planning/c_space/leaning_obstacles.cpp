// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/leaning_obstacles.hpp"

namespace adit {

LeaningObstacles::LeaningObstacles(const TerrainMap& terrain)
    : trend_(terrain.ground_m(), terrain.cell_m), cell_m_(terrain.cell_m) {}

Eigen::Vector2d LeaningObstacles::displacement_m(int column, int row, double height_m) const {
  const Eigen::Vector2d grade = trend_.rise_m(column, row).cast<double>() / cell_m_;
  return height_m / (1.0 + grade.squaredNorm()) * grade;
}

}  // namespace adit
