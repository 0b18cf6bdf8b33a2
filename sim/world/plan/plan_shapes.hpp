// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace adit {

/// A straight piece of a drift. An end is flat, or round where the drift goes on or meets another.
struct TunnelSegment {
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

using PlanShape = std::variant<TunnelSegment, PlanPolygon>;

/// How far inside the shape a place is: the distance to its edge, negative outside [m].
double depth_m(const TunnelSegment& segment, const Eigen::Vector2d& p_world);
double depth_m(const PlanPolygon& polygon, const Eigen::Vector2d& p_world);
double depth_m(const PlanShape& shape, const Eigen::Vector2d& p_world);

/// A rectangle that the shape does not leave.
Eigen::AlignedBox2d bounds(const PlanShape& shape);

/// Squares of the plan, each of which knows the shapes within reach of it, so that nobody asks a
/// shape far away.
class PlanBuckets {
 public:
  /// The squares cover the shapes and `reach_m` around them.
  PlanBuckets(const std::vector<PlanShape>& shapes, double side_m, double reach_m);

  /// Indices of the shapes, ascending; none outside of all squares.
  [[nodiscard]] std::span<const std::uint32_t> at(const Eigen::Vector2d& p_world) const;
  [[nodiscard]] std::span<const std::uint32_t> at(int column, int row) const;

  [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }  ///< lowest corner
  [[nodiscard]] double side_m() const { return side_m_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }

 private:
  [[nodiscard]] std::vector<std::size_t> squares_near(const PlanShape& shape, double reach_m) const;

  Eigen::Vector2d origin_{0.0, 0.0};
  double side_m_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> starts_;  ///< of the shapes of each square, row by row, and the end
  std::vector<std::uint32_t> shapes_;
};

}  // namespace adit
