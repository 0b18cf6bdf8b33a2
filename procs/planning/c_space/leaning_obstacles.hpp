// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/grid/ground_trend.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// Where obstacles stand beside a body that is inclined with the ground. The footprint is that of a
/// body at right angles to the ground; a plumb wall leans over it: on a cross slope of 12 % the top
/// of a body 1 m high is 0.12 m nearer to the wall on the low side than its wheels are. A point at
/// the height h above ground with the grade g therefore stands h g / (1 + |g|²) uphill of the cell
/// below it, at the foot of the perpendicular to the ground.
class LeaningObstacles {
 public:
  explicit LeaningObstacles(const TerrainMap& terrain);

  /// Displacement of a point `height_m` above the ground of a cell, in level [m].
  [[nodiscard]] Eigen::Vector2d displacement_m(int column, int row, double height_m) const;

 private:
  GroundTrend trend_;
  double cell_m_;
};

}  // namespace adit
