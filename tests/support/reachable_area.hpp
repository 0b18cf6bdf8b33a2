// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/types/vehicle.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Steepest ground that planning accepts by default (procs/planning: slope_max_rad).
inline constexpr double kSlopeMaxRad = 0.35;

/// Squares of a PassableRaster under a vehicle: column and row, relative to the lowest square of
/// the cell that contains the centre of the vehicle.
using Footprint = std::vector<std::array<int, 2>>;

/// Footprints of the poses within one cell and one heading bin: the central pose first, then poses
/// shifted by a third of the cell in x and y and turned by a third of the heading step.
std::vector<Footprint> footprints(const Vehicle& vehicle, double heading_rad, double cell_m);

/// Positions that the origin of a vehicle can reach.
struct ReachableArea {
  static constexpr double kSide = 0.2;  ///< of a cell [m]

  std::vector<Eigen::Vector2d> cells;  ///< cell centres, p_world [m]
  std::vector<int> levels = {};        ///< of each cell
  double area_m2 = 0.0;
  /// For each edge of the tunnel graph, the length that is reachable somewhere across its width
  /// [m].
  std::vector<double> edge_length_m;
};

/// The area that a vehicle can reach from the start pose, from ground truth. A flood fill over
/// cells of 0.2 m and 16 headings moves the rectangle of the vehicle along its heading, with turns
/// of about 25° between adjacent cells, wherever it touches neither rock nor an obstacle that is
/// not passable (is_passable). The result generally overestimates the drivable area: turns are
/// tighter than the turning radius, and poses may shift by a third of a cell and of a heading step
/// to fit; but obstacles block their complete outline. The bare floor counts: a pose whose four
/// wheels stand on a plane steeper than `slope_max_rad`, or next to a step higher than the vehicle
/// climbs, is not reached. It passes from one level to another where both have the same floor.
/// Empty if the vehicle does not fit at the start or the world has no plan. Throws
/// std::invalid_argument if the plan is too large.
ReachableArea reachable_area(const World& world, const Vehicle& vehicle,
                             double slope_max_rad = kSlopeMaxRad);

}  // namespace adit
