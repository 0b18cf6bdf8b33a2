// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The part of a convex polygon, given by its corners in order, on the side of a line (of a plane,
/// in space) where normal · p ≤ offset (Sutherland and Hodgman, "Reentrant polygon clipping",
/// 1974).
template <class Point>
std::vector<Point> clipped(const std::vector<Point>& corners, const Point& normal, double offset) {
  std::vector<Point> inside;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    const double out_a = normal.dot(a) - offset;
    const double out_b = normal.dot(b) - offset;
    if (out_a <= 0.0) inside.push_back(a);
    if ((out_a < 0.0 && out_b > 0.0) || (out_a > 0.0 && out_b < 0.0))
      inside.push_back(a + out_a / (out_a - out_b) * (b - a));
  }
  return inside;
}

}  // namespace adit
