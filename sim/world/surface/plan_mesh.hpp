// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/open_space.hpp"

namespace adit {

/// Triangulation of the open space in plan. Triangles share their vertices.
struct PlanMesh {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<Eigen::Vector2d> points;                  ///< p_world [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
  /// For each point on a wall, the next point with open space to the left; kNone for all others.
  /// The walls are closed lines.
  std::vector<std::uint32_t> next_on_wall;

  [[nodiscard]] bool is_on_wall(std::uint32_t point) const { return next_on_wall[point] != kNone; }
};

/// Marching squares (Lorensen and Cline 1987, in the plane). Walls cross the grid edges where the
/// depth is zero; an ambiguous square is open in its centre if the mean depth is positive. No wall
/// segment is shorter than a tenth of an edge, except in walls of three segments. Throws
/// std::invalid_argument for a plan that is too large for the grid.
PlanMesh plan_mesh(const OpenSpace& space, double grid_m);

/// Merges neighbouring wall points closer than `shortest_m` at their midpoint, since the wall above
/// so short a segment would have an arbitrary normal. A wall keeps at least three points.
void merge_short_walls(PlanMesh& mesh, double shortest_m);

}  // namespace adit
