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

/// A straight segment of a tunnel. Its ends are flat, or round where the tunnel continues or meets
/// another.
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

/// Signed distance to the edge of the shape, negative outside [m].
double depth_m(const TunnelSegment& segment, const Eigen::Vector2d& p_world);
double depth_m(const PlanPolygon& polygon, const Eigen::Vector2d& p_world);
double depth_m(const PlanShape& shape, const Eigen::Vector2d& p_world);

/// Bounding rectangle.
Eigen::AlignedBox2d bounds(const PlanShape& shape);
Eigen::AlignedBox2d bounds(const std::vector<PlanShape>& shapes);

/// Spatial index: square cells of the plan with the shapes within reach of each.
class PlanBuckets {
 public:
  /// The cells cover the shapes and a margin of `reach_m`.
  PlanBuckets(const std::vector<PlanShape>& shapes, double side_m, double reach_m)
      : PlanBuckets(shapes, side_m, reach_m, bounds(shapes)) {}
  /// The cells cover a rectangle, which contains the shapes, and a margin.
  PlanBuckets(const std::vector<PlanShape>& shapes, double side_m, double reach_m,
              const Eigen::AlignedBox2d& all);

  /// Indices of the shapes, ascending; empty outside of all cells.
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
  std::vector<std::uint32_t> starts_;  ///< of the shapes of each cell, row by row, and the end
  std::vector<std::uint32_t> shapes_;
};

}  // namespace adit
