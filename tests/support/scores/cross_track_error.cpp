// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/cross_track_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kBehindM = 0.3;
constexpr double kAheadM = 0.6;
constexpr double kSameM = 1e-3;

}  // namespace

CrossTrackError::CrossTrackError(const std::vector<PathPoint>& points) {
  for (const PathPoint& point : points) {
    const Eigen::Vector2d p = point.T_odom_body.translation();
    path_lengths_m_.push_back(
        positions_.empty() ? 0.0 : path_lengths_m_.back() + (p - positions_.back()).norm());
    positions_.push_back(p);
  }
}

double CrossTrackError::operator()(const Eigen::Vector2d& p_odom) {
  double least = std::numeric_limits<double>::infinity();
  double left = 0.0;
  double s_m = s_m_;
  for (std::size_t i = 0; i + 1 < positions_.size(); ++i) {
    if (path_lengths_m_[i + 1] < s_m_ - kBehindM || path_lengths_m_[i] > s_m_ + kAheadM) continue;
    const Eigen::Vector2d along = positions_[i + 1] - positions_[i];
    if (along.norm() < kSameM) continue;
    const double t = std::clamp(along.dot(p_odom - positions_[i]) / along.squaredNorm(), 0.0, 1.0);
    const Eigen::Vector2d off = p_odom - positions_[i] - t * along;
    if (off.norm() >= least) continue;
    least = off.norm();
    left = std::copysign(least, along.x() * off.y() - along.y() * off.x());
    s_m = path_lengths_m_[i] + t * along.norm();
  }
  s_m_ = std::max(s_m_, s_m);
  return left;
}

}  // namespace adit
