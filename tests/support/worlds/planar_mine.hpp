// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "sim/world/world.hpp"
#include "tests/support/reachable_area.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A 2D mine without physics: the walls that a level laser measures, and the reachable area.
struct PlanarMine {
  WallWorld walls;
  Pose2 T_world_start;
  std::function<bool(const Eigen::Vector2d& p_world)> reachable;
  /// Points on the centre lines of the reachable tunnels, kSpacingM apart: the corridor to explore.
  std::vector<Eigen::Vector2d> corridor;

  static constexpr double kSpacingM = 0.5;
  [[nodiscard]] double corridor_m() const {
    return kSpacingM * static_cast<double>(corridor.size());
  }
};

/// The plan of a world, open at its entrances, with all obstacles at the height of the lasers.
/// Of several levels, the first. Reachable is what a vehicle reaches on ground that is not steeper
/// than `slope_max_rad`.
PlanarMine planar_mine(const World& world, const Vehicle& vehicle = {},
                       double slope_max_rad = kSlopeMaxRad);
/// One for each of WorldTruth::levels.
std::vector<PlanarMine> planar_mines(const World& world, const Vehicle& vehicle,
                                     double slope_max_rad);

/// A mine of the given walls and corridor points, for a round vehicle.
PlanarMine planar_mine(std::vector<Segment> walls, const Pose2& T_world_start,
                       std::vector<Eigen::Vector2d> corridor = {}, double radius_m = 0.62);

}  // namespace adit::test
