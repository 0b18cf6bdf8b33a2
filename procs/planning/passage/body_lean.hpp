// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/grid/ground_trend.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// How the body leans where its wheels stand at different heights, on stones or rails: its top is
/// then beside its wheels, nearer to a wall. Relative to the trend of the ground, along which
/// obstacles lean already (LeaningObstacles). The body stands on the plane of its four wheels.
class BodyLean {
 public:
  BodyLean(const TerrainMap& terrain, const Vehicle& vehicle);

  /// Displacement of the top of the body relative to its wheels, in body [m]. Zero where wheels
  /// differ by less than noise and pebbles, and where the ground under them is not observed.
  [[nodiscard]] Eigen::Vector2d top_m(const Pose2& T_level_body) const;

 private:
  [[nodiscard]] double wheel_height_m(const Pose2& T_level_body, double x_m, double y_m) const;

  Vehicle vehicle_;
  Eigen::Vector2d p_level_corner_;
  double cell_m_;
  Grid2<float> tops_m_;  ///< of what wheels climb, z in level; NaN where there is none
  GroundTrend trend_;
};

}  // namespace adit
