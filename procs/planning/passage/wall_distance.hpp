// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/planning/c_space/ground_layers.hpp"
#include "procs/planning/passage/body_lean.hpp"

namespace adit {

/// Distances to what blocks the body, at the resolution of the parts of cells (CellParts). Where
/// the terrain map says in which parts of a cell an obstacle stands, only these block: a cell that
/// is lethal since its region contains points of a wall beside it is free, as is one that is
/// unobserved only since it is near a shadow that begins behind a wall. All other cells that are
/// lethal to the body or to the wheels, and unobserved ones, block as a whole. What lies under the
/// robot is free.
///
/// What ends below the beams of the level lasers counts as nearer by kUnseenM: beside the robot,
/// neither centring nor the guard measures it again, and the beams of a 3D scan miss the tips of
/// rubble.
class WallDistance {
 public:
  /// The pose of the robot is in level; `level_beam_m` is the height of the level lasers.
  WallDistance(const TerrainMap& terrain, const GroundLayers& layers, const Pose2& T_level_body,
               const Vehicle& vehicle, const GroundLimits& limits, double level_beam_m);

  /// Distance from a point to the centre of the nearest blocked part, interpolated [m]; 0 outside
  /// the map.
  [[nodiscard]] double at(const Eigen::Vector2d& p_level) const;

  /// Free width on each side of the body, beyond its flanks, over its whole length [m]; at most
  /// kSideMaxM. Negative where its flank is blocked.
  struct Sides {
    double left_m = 0.0;
    double right_m = 0.0;
  };
  [[nodiscard]] Sides sides(const Pose2& T_level_body) const;
  /// Least distance from the outline of the body to what blocks it [m].
  [[nodiscard]] double clearance_m(const Pose2& T_level_body) const;

  static constexpr double kSideMaxM = 1.0;
  static constexpr double kUnseenM = 0.075;

 private:
  [[nodiscard]] double outline_clearance_m(const Pose2& T_level_outline) const;
  [[nodiscard]] double free_beside_m(const Eigen::Vector2d& p_level,
                                     const Eigen::Vector2d& direction) const;

  Eigen::Vector2d p_level_corner_;
  double part_m_;
  Eigen::Vector2d half_m_;                ///< half the length and half the width of the body
  std::vector<Eigen::Vector2d> outline_;  ///< points along the outline of the body
  BodyLean lean_;
  Grid2<float> distance_m_;
};

}  // namespace adit
