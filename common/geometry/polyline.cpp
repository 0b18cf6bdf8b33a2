// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/polyline.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace adit {

Polyline::Polyline(std::vector<Eigen::Vector2d> points) : points_(std::move(points)), at_m_{0.0} {
  for (std::size_t i = 1; i < points_.size(); ++i)
    at_m_.push_back(at_m_.back() + (points_[i] - points_[i - 1]).norm());
}

Eigen::Vector2d Polyline::at(double distance_m) const {
  const auto next = std::lower_bound(at_m_.begin(), at_m_.end(), distance_m);
  const auto i = static_cast<std::size_t>(next - at_m_.begin());
  if (i == 0) return points_.front();
  if (i == points_.size()) return points_.back();
  const double step = at_m_[i] - at_m_[i - 1];
  return points_[i] + (points_[i - 1] - points_[i]) * ((at_m_[i] - distance_m) / step);
}

Polyline::Nearest Polyline::nearest(const Eigen::Vector2d& p, double from_m, double to_m) const {
  Nearest best{0.0, std::numeric_limits<double>::infinity()};
  const auto past = std::upper_bound(at_m_.begin(), at_m_.end(), from_m) - at_m_.begin();
  for (auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(past, 1));
       i < points_.size() && at_m_[i - 1] <= to_m; ++i) {
    const Eigen::Vector2d leg = points_[i] - points_[i - 1];
    const double leg_m = at_m_[i] - at_m_[i - 1];
    if (leg_m <= 0.0) continue;
    const double on_leg_m = std::clamp((p - points_[i - 1]).dot(leg) / leg_m,
                                       std::clamp(from_m - at_m_[i - 1], 0.0, leg_m),
                                       std::clamp(to_m - at_m_[i - 1], 0.0, leg_m));
    const double beside_m = (points_[i - 1] + on_leg_m / leg_m * leg - p).norm();
    if (beside_m < best.beside_m) best = {at_m_[i - 1] + on_leg_m, beside_m};
  }
  return best;
}

Eigen::Vector2d Polyline::chord_at(double distance_m, double reach_m) const {
  return at(std::min(distance_m + reach_m, length_m())) - at(std::max(distance_m - reach_m, 0.0));
}

}  // namespace adit
