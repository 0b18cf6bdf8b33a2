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

/// The open space in plan as triangles, which share their corners.
struct PlanMesh {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<Eigen::Vector2d> points;                  ///< p_world [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise
  /// For each point on a wall the next one, with open space to the left; kNone for all others. The
  /// walls are closed lines.
  std::vector<std::uint32_t> next_on_wall;

  [[nodiscard]] bool is_on_wall(std::uint32_t point) const { return next_on_wall[point] != kNone; }
};

/// Marching squares over a grid (Lorensen and Cline 1987, in the plane). Walls are met where the
/// depth is zero along an edge of the grid; a square with open corners across from each other is
/// open in its middle if their mean is. No piece of wall is shorter than a tenth of an edge, but
/// for walls of three pieces. Throws std::invalid_argument for a plan that is too large for such a
/// grid.
PlanMesh plan_mesh(const OpenSpace& space, double grid_m);

/// Makes one point of neighbours on a wall that are nearer than `shortest_m`, half-way between
/// them: what stands on so short a piece of wall would be a strip that faces anywhere. A wall keeps
/// at least three points.
void merge_short_walls(PlanMesh& mesh, double shortest_m);

}  // namespace adit
