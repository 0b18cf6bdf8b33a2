// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "common/types/vehicle.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Squares of a PassableRaster under a vehicle, by column and row, counted from the lowest square
/// of the cell in which its middle is.
using Footprint = std::vector<std::array<int, 2>>;

/// The ways to stand in a cell with about one heading, the middle of all first: off by a third of
/// the cell or of the step between headings to either side.
std::vector<Footprint> footprints(const Vehicle& vehicle, double heading_rad, double cell_m);

/// Where the origin of a vehicle can be.
struct ReachableArea {
  static constexpr double kSide = 0.2;  ///< of a cell [m]

  std::vector<Eigen::Vector2d> cells;  ///< middles, p_world [m]
  double area_m2 = 0.0;
  /// Of each edge of the drift graph, that much can be reached somewhere across its width [m].
  std::vector<double> edge_length_m;
};

/// Where a vehicle can get to from the start of the world, by the truth: its rectangle is moved
/// along its heading, with turns of about 25° from one cell to the next, over cells of 0.2 m and 16
/// headings, where it touches neither rock nor an obstacle that it cannot pass (is_passable). More
/// than what can be driven, on the whole: it turns in less than any real radius, may be off by a
/// third of a cell and of a step of heading to fit, and does not tilt; but obstacles count with the
/// whole of their outlines. Empty where the vehicle does not fit at the start, or the plan is not
/// known.
/// Throws std::invalid_argument for a plan too large.
ReachableArea reachable_area(const World& world, const Vehicle& vehicle);

}  // namespace adit
