// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/props/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/world/plan/plan_geometry.hpp"

namespace adit {
namespace {

bool turns_left(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross(b - a, c - a) > 0.0;
}

/// The lower chain of sorted points, without its last point, which is the first of the other chain.
template <class Iterator>
void append_chain(Iterator begin, Iterator end, std::vector<Eigen::Vector2d>& outline) {
  const std::size_t first = outline.size();
  for (Iterator it = begin; it != end; ++it) {
    while (outline.size() >= first + 2 &&
           !turns_left(outline[outline.size() - 2], outline.back(), *it)) {
      outline.pop_back();
    }
    outline.push_back(*it);
  }
  outline.pop_back();
}

}  // namespace

std::vector<Eigen::Vector2d> convex_outline(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return points;
  std::vector<Eigen::Vector2d> outline;
  append_chain(points.begin(), points.end(), outline);
  append_chain(points.rbegin(), points.rend(), outline);
  return outline;
}

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
