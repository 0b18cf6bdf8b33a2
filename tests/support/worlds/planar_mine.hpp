// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "sim/world/world.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A mine without physics: what a laser sees of its plan, and where a vehicle can be.
struct PlanarMine {
  WallWorld walls;
  Pose2 T_world_start;
  std::function<bool(const Eigen::Vector2d& p_world)> reachable;
  /// Places in the middles of the tunnels that can be reached, kSpacingM apart: what there is to
  /// explore.
  std::vector<Eigen::Vector2d> corridor;

  static constexpr double kSpacingM = 0.5;
  [[nodiscard]] double corridor_m() const {
    return kSpacingM * static_cast<double>(corridor.size());
  }
};

/// The plan of a world, open at its entrances, with what stands as high as the lasers.
PlanarMine planar_mine(const World& world, const Vehicle& vehicle = {});

/// Walls by hand, for a round vehicle; there is nothing to explore but what is given.
PlanarMine planar_mine(std::vector<Segment> walls, const Pose2& T_world_start,
                       std::vector<Eigen::Vector2d> corridor = {}, double radius_m = 0.62);

}  // namespace adit::test
