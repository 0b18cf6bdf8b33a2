// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

/// A straight piece of a drift. An end is flat, or round where the drift goes on or meets another.
struct DriftPiece {
  Eigen::Vector2d from{0.0, 0.0};   ///< p_world [m]
  Eigen::Vector2d along{1.0, 0.0};  ///< unit
  double length_m = 0.0;
  double half_width_m = 0.0;
  bool flat_start = false;
  bool flat_end = false;
};

/// The corners in order, p_world [m].
struct PlanPolygon {
  std::vector<Eigen::Vector2d> corners;
};

using PlanShape = std::variant<DriftPiece, PlanPolygon>;

/// How far inside the shape a place is: the distance to its edge, negative outside [m].
double depth_m(const DriftPiece& piece, const Eigen::Vector2d& p_world);
double depth_m(const PlanPolygon& polygon, const Eigen::Vector2d& p_world);
double depth_m(const PlanShape& shape, const Eigen::Vector2d& p_world);

/// A rectangle that the shape does not leave.
Eigen::AlignedBox2d bounds(const PlanShape& shape);

}  // namespace adit
