// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/goal_route.hpp"

#include <algorithm>
#include <limits>

namespace adit {
namespace {

constexpr double kPointDistanceMinM = 1e-3;

}  // namespace

GoalRoute::GoalRoute(const std::vector<Eigen::Vector2d>& points) {
  for (const Eigen::Vector2d& p : points) {
    const double distance_m = points_.empty() ? 0.0 : (p - points_.back()).norm();
    if (!points_.empty() && distance_m < kPointDistanceMinM) continue;
    s_m_.push_back(length_m() + distance_m);
    points_.push_back(p);
  }
}

GoalRoute::Projection GoalRoute::nearest(const Eigen::Vector2d& p_level) const {
  Projection best;
  best.lateral_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double length_m = s_m_[i + 1] - s_m_[i];
    const Eigen::Vector2d tangent = (points_[i + 1] - points_[i]) / length_m;
    const bool last = i + 2 == points_.size();
    const double along_max_m = last ? std::numeric_limits<double>::infinity() : length_m;
    const double along_m = std::clamp((p_level - points_[i]).dot(tangent), 0.0, along_max_m);
    const double lateral_m = (points_[i] + along_m * tangent - p_level).norm();
    if (lateral_m < best.lateral_m) best = {s_m_[i] + along_m, lateral_m, tangent};
  }
  return best;
}

Eigen::Vector2d GoalRoute::point(double s_m) const {
  const auto after = std::ranges::upper_bound(s_m_, s_m);
  const auto segments = static_cast<std::ptrdiff_t>(points_.size()) - 1;
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - s_m_.begin() - 1, 0, segments - 1));
  const double share = (s_m - s_m_[i]) / (s_m_[i + 1] - s_m_[i]);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

}  // namespace adit
