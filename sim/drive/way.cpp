// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {

LeggedWay::LeggedWay(std::vector<Eigen::Vector2d> points)
    : points_(std::move(points)), starts_m_{0.0} {
  for (std::size_t i = 1; i < points_.size(); ++i) {
    starts_m_.push_back(starts_m_.back() + (points_[i] - points_[i - 1]).norm());
  }
}

Eigen::Vector2d LeggedWay::at(double s_m) const {
  const std::size_t i = leg(s_m);
  return points_[i] + (s_m - starts_m_[i]) * direction(i);
}

std::size_t LeggedWay::leg(double s_m) const {
  const auto next = std::upper_bound(starts_m_.begin() + 1, starts_m_.end() - 1, s_m);
  return static_cast<std::size_t>(next - starts_m_.begin()) - 1;
}

double LeggedWay::heading_rad(std::size_t leg) const {
  const Eigen::Vector2d ahead = direction(leg);
  return std::atan2(ahead.y(), ahead.x());
}

double LeggedWay::nearest_m(const Eigen::Vector2d& p_world, double from_m, double to_m) const {
  double nearest = from_m;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = leg(from_m); i <= leg(to_m); ++i) {
    const double low = std::max(from_m, starts_m_[i]);
    const double high = std::max(low, std::min(to_m, starts_m_[i + 1]));
    const double s = starts_m_[i] + (p_world - points_[i]).dot(direction(i));
    const double here = std::clamp(s, low, high);
    const double d = (at(here) - p_world).norm();
    if (d >= distance) continue;
    distance = d;
    nearest = here;
  }
  return nearest;
}

Eigen::Vector2d LeggedWay::direction(std::size_t leg) const {
  return (points_[leg + 1] - points_[leg]).normalized();
}

}  // namespace adit
