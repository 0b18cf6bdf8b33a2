// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/segment.hpp"

#include <algorithm>

namespace adit {

Eigen::Vector2d nearest_point(const Segment2& segment, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double square = along.squaredNorm();
  if (square == 0.0) return segment.from;
  const double share = std::clamp((p - segment.from).dot(along) / square, 0.0, 1.0);
  return segment.from + share * along;
}

/// Unless they cross, the nearest points of two segments include an end of one of them.
ClosestPair nearest_points(const Segment2& a, const Segment2& b) {
  const Eigen::Vector2d along_a = a.to - a.from;
  const Eigen::Vector2d along_b = b.to - b.from;
  const double area = cross(along_a, along_b);
  if (area != 0.0) {
    const Eigen::Vector2d apart = b.from - a.from;
    const double on_a = cross(apart, along_b) / area;
    const double on_b = cross(apart, along_a) / area;
    if (on_a >= 0.0 && on_a <= 1.0 && on_b >= 0.0 && on_b <= 1.0) {
      const Eigen::Vector2d p = a.from + on_a * along_a;
      return {p, p};
    }
  }
  ClosestPair best{a.from, nearest_point(b, a.from)};
  for (const ClosestPair& pair :
       {ClosestPair{a.to, nearest_point(b, a.to)}, ClosestPair{nearest_point(a, b.from), b.from},
        ClosestPair{nearest_point(a, b.to), b.to}}) {
    if (pair.distance() < best.distance()) best = pair;
  }
  return best;
}

}  // namespace adit
