// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/circle.hpp"

#include <cmath>
#include <numbers>

namespace adit {

std::vector<Eigen::Vector2d> around_circle(const Eigen::Vector2d& middle, double radius_m) {
  constexpr int kCorners = 24;
  const double to_corner_m = radius_m / std::cos(std::numbers::pi / kCorners);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    corners.emplace_back(middle + to_corner_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

}  // namespace adit
