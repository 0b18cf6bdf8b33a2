// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace adit {

/// The area of the parallelogram of two vectors: positive where `b` points to the left of `a`.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A straight line between two points of the plane, which may be the same.
struct Segment2 {
  Eigen::Vector2d from{0.0, 0.0};
  Eigen::Vector2d to{0.0, 0.0};
};

/// The point of the segment that is nearest to p.
[[nodiscard]] Eigen::Vector2d nearest_point(const Segment2& segment, const Eigen::Vector2d& p);

/// Points of both that are nearest to each other; the same where the segments cross.
struct ClosestPair {
  Eigen::Vector2d on_a{0.0, 0.0};
  Eigen::Vector2d on_b{0.0, 0.0};

  [[nodiscard]] double distance() const { return (on_b - on_a).norm(); }
};
[[nodiscard]] ClosestPair nearest_points(const Segment2& a, const Segment2& b);

}  // namespace adit
