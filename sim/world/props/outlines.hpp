// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// Convex hull, counter-clockwise (Andrew's monotone chain, 1979). Fewer than three corners if the
/// points are collinear.
std::vector<Eigen::Vector2d> convex_outline(std::vector<Eigen::Vector2d> points);

/// A regular polygon around a circle, counter-clockwise, p_world [m].
std::vector<Eigen::Vector2d> around_circle(const Eigen::Vector2d& middle, double radius_m);

/// A rectangle of the plan along the axes, p_world [m].
struct PlanBox {
  Eigen::Vector2d low{0.0, 0.0};
  Eigen::Vector2d high{0.0, 0.0};
};

inline PlanBox box_around(const std::vector<Eigen::Vector2d>& points) {
  PlanBox box{points.front(), points.front()};
  for (const Eigen::Vector2d& point : points) {
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

inline PlanBox box_around(const Eigen::Vector2d& middle, double radius_m) {
  return {middle.array() - radius_m, middle.array() + radius_m};
}

}  // namespace adit
