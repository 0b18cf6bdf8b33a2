// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/true_lateral_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kBehindM = 0.3;
constexpr double kAheadM = 0.6;
constexpr double kSameM = 1e-3;

}  // namespace

TrueLateralError::TrueLateralError(const std::vector<PathPoint>& points) {
  for (const PathPoint& point : points) {
    const Eigen::Vector2d p = point.T_odom_body.translation();
    ways_m_.push_back(places_.empty() ? 0.0 : ways_m_.back() + (p - places_.back()).norm());
    places_.push_back(p);
  }
}

double TrueLateralError::operator()(const Eigen::Vector2d& p_odom) {
  double least = std::numeric_limits<double>::infinity();
  double left = 0.0;
  double s_m = s_m_;
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    if (ways_m_[i + 1] < s_m_ - kBehindM || ways_m_[i] > s_m_ + kAheadM) continue;
    const Eigen::Vector2d along = places_[i + 1] - places_[i];
    if (along.norm() < kSameM) continue;
    const double t = std::clamp(along.dot(p_odom - places_[i]) / along.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector2d off = p_odom - places_[i] - t * along;
    if (off.norm() >= least) continue;
    least = off.norm();
    left = std::copysign(least, along.x() * off.y() - along.y() * off.x());
    s_m = ways_m_[i] + t * along.norm();
  }
  s_m_ = std::max(s_m_, s_m);
  return left;
}

}  // namespace adit
