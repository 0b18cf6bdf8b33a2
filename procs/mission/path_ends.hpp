// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include <Eigen/Core>

namespace adit {

/// Where the last paths ended, in odom. That a path was found and driven does not say that it led
/// anywhere: whoever asks for the next may be sent to the same place again, for ever.
class PathEnds {
 public:
  static constexpr std::size_t kInVain = 6;  ///< paths in a row; a turn in a drift takes three
  static constexpr double kSamePlaceM = 1.0;

  /// Another path has ended. Whether it and those before it ended at one place; counting begins
  /// anew then.
  [[nodiscard]] bool add_is_in_vain(const Eigen::Vector2d& p_odom) {
    p_odom_.push_back(p_odom);
    if (p_odom_.size() < kInVain) return false;
    const bool same = std::all_of(p_odom_.begin(), p_odom_.end(), [&](const Eigen::Vector2d& p) {
      return (p - p_odom).norm() < kSamePlaceM;
    });
    same ? p_odom_.clear() : p_odom_.pop_front();
    return same;
  }

 private:
  std::deque<Eigen::Vector2d> p_odom_;  ///< the newest last, fewer than kInVain
};

}  // namespace adit
