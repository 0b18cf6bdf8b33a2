// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include <Eigen/Core>

namespace adit {

/// Where attempts were first refused, in odom: who comes back to such a place has not got on. The
/// newest alone are kept, which is more than any part of a mine has.
class RefusedPlaces {
 public:
  static constexpr std::size_t kPlaces = 500;

  void add(const Eigen::Vector2d& p_odom) {
    p_odom_.push_back(p_odom);
    if (p_odom_.size() > kPlaces) p_odom_.pop_front();
  }

  /// Whether none is as near as that.
  [[nodiscard]] bool all_beyond(double distance_m, const Eigen::Vector2d& p_odom_body) const {
    return std::all_of(p_odom_.begin(), p_odom_.end(), [&](const Eigen::Vector2d& p_odom) {
      return (p_odom_body - p_odom).norm() > distance_m;
    });
  }

 private:
  std::deque<Eigen::Vector2d> p_odom_;  ///< the newest last
};

}  // namespace adit
