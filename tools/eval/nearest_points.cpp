// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/nearest_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace adit {

NearestPoints::NearestPoints(const std::vector<Eigen::Vector2d>& points, double max_distance_m)
    : max_distance_m_(max_distance_m) {
  points_.reserve(points.size());
  for (const Eigen::Vector2d& p : points) points_.emplace_back(cell_at(p), p);
  std::stable_sort(points_.begin(), points_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

double NearestPoints::distance_m(const Eigen::Vector2d& p) const {
  const auto [i, j] = cell_at(p);
  double nearest = std::numeric_limits<double>::infinity();
  for (int column = i - 1; column <= i + 1; ++column) {
    // The cells of one column are adjacent in the order.
    auto at = std::lower_bound(points_.begin(), points_.end(), Cell{column, j - 1},
                               [](const auto& a, const Cell& cell) { return a.first < cell; });
    for (; at != points_.end() && at->first <= Cell{column, j + 1}; ++at) {
      nearest = std::min(nearest, (at->second - p).norm());
    }
  }
  return nearest <= max_distance_m_ ? nearest : std::numeric_limits<double>::infinity();
}

NearestPoints::Cell NearestPoints::cell_at(const Eigen::Vector2d& p) const {
  return {static_cast<int>(std::floor(p.x() / max_distance_m_)),
          static_cast<int>(std::floor(p.y() / max_distance_m_))};
}

std::vector<Eigen::Vector2d> downsampled(const std::vector<Eigen::Vector2d>& points,
                                         double spacing_m) {
  std::set<std::pair<int, int>> occupied;
  std::vector<Eigen::Vector2d> first;
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Array2i cell = (p / spacing_m).array().floor().cast<int>();
    if (occupied.emplace(cell.x(), cell.y()).second) first.push_back(p);
  }
  return first;
}

}  // namespace adit
