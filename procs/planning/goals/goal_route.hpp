// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// The route of a goal: a polyline in level that the robot follows as far as it can.
class GoalRoute {
 public:
  /// The point of the polyline that is nearest to a given point.
  struct Projection {
    double s_m = 0.0;         ///< arc length; the last segment is extended beyond its end
    double lateral_m = 0.0;   ///< distance of the given point
    Eigen::Vector2d tangent;  ///< unit vector
  };

  GoalRoute() = default;
  /// Points less than 1 mm from their predecessor are left out.
  explicit GoalRoute(const std::vector<Eigen::Vector2d>& points);

  /// Whether there are fewer than two points.
  [[nodiscard]] bool empty() const { return points_.size() < 2; }
  [[nodiscard]] double length_m() const { return s_m_.empty() ? 0.0 : s_m_.back(); }
  /// The route must not be empty. The first of several nearest points.
  [[nodiscard]] Projection nearest(const Eigen::Vector2d& p_level) const;
  /// The point at an arc length, in level; the last segment is extended beyond its end. The route
  /// must not be empty.
  [[nodiscard]] Eigen::Vector2d point(double s_m) const;

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> s_m_;  ///< arc length at each point
};

}  // namespace adit
