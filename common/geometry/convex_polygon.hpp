// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A convex polygon in a plane [m].
class ConvexPolygon {
 public:
  /// The convex hull of points; empty if they lie on one line.
  explicit ConvexPolygon(std::vector<Eigen::Vector2d> points);
  /// An axis-aligned rectangle around `middle`; `half` is half its length and half its width.
  [[nodiscard]] static ConvexPolygon rectangle(const Eigen::Vector2d& middle,
                                               const Eigen::Vector2d& half);

  /// Counterclockwise.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& corners() const& { return corners_; }
  [[nodiscard]] std::vector<Eigen::Vector2d> corners() && { return std::move(corners_); }
  /// The line of an edge: the polygon is on the side where normal · p ≤ offset_m.
  struct Edge {
    Eigen::Vector2d normal;  ///< outwards, of length 1
    double offset_m = 0.0;
  };
  /// `edges()[i]` leads from corner i to the next one.
  [[nodiscard]] const std::vector<Edge>& edges() const& { return edges_; }
  [[nodiscard]] std::vector<Edge> edges() && { return std::move(edges_); }
  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] double area_m2() const;
  /// Distance of the farthest corner from the origin.
  [[nodiscard]] double radius_m() const;
  /// The largest coordinates of its corners.
  [[nodiscard]] const Eigen::Vector2d& high() const { return high_; }
  [[nodiscard]] const Eigen::Vector2d& low() const { return low_; }

  /// Including the edges.
  [[nodiscard]] bool contains(const Eigen::Vector2d& p) const;
  /// Distance of the point from the polygon; 0 inside [m].
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p) const;
  /// Whether it intersects the open, axis-aligned square of side 2 · `half_m` around `p`, by the
  /// separating axis theorem.
  [[nodiscard]] bool meets_square(const Eigen::Vector2d& p, double half_m) const;
  /// Corners and points between them along the edges, at most `spacing_m` apart.
  [[nodiscard]] std::vector<Eigen::Vector2d> boundary(double spacing_m) const;

  /// With each edge moved outwards, or inwards if negative; empty if nothing is left.
  [[nodiscard]] ConvexPolygon grown(double by_m) const;
  /// What it covers when it moves by up to `by_m` to either side along y.
  [[nodiscard]] ConvexPolygon widened(double by_m) const;
  /// The polygon of a frame b in the frame a.
  [[nodiscard]] ConvexPolygon moved(const Pose2& T_a_b) const;

 private:
  std::vector<Eigen::Vector2d> corners_;
  std::vector<Edge> edges_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_ = Eigen::Vector2d::Zero();
};

}  // namespace adit
