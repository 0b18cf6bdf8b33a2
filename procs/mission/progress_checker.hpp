// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>

#include <Eigen/Core>

namespace adit {

/// Where the last paths ended, in odom. That a path was found and driven does not say that it led
/// anywhere: whoever asks for the next may be sent to the same place again, for ever.
class PathEnds {
 public:
  static constexpr std::size_t kSamePlaceMax =
      6;  ///< paths in a row; a turn in a drift takes three
  static constexpr double kSamePlaceM = 1.0;

  /// Another path has ended. Whether it and those before it ended at one place; counting begins
  /// anew then.
  [[nodiscard]] bool add_and_check_stuck(const Eigen::Vector2d& p_odom) {
    p_odom_.push_back(p_odom);
    if (p_odom_.size() < kSamePlaceMax) return false;
    const bool same = std::all_of(p_odom_.begin(), p_odom_.end(), [&](const Eigen::Vector2d& p) {
      return (p - p_odom).norm() < kSamePlaceM;
    });
    same ? p_odom_.clear() : p_odom_.pop_front();
    return same;
  }

 private:
  std::deque<Eigen::Vector2d> p_odom_;  ///< the newest last, fewer than kSamePlaceMax
};

/// Where attempts were first refused, in odom: who comes back to such a place has not got on. The
/// newest alone are kept, which is more than any part of a mine has.
class RejectedPlaces {
 public:
  static constexpr std::size_t kPlacesStoredMax = 500;

  void add(const Eigen::Vector2d& p_odom) {
    p_odom_.push_back(p_odom);
    if (p_odom_.size() > kPlacesStoredMax) p_odom_.pop_front();
  }

  /// Whether none is as near as that.
  [[nodiscard]] bool all_farther_than(double distance_m, const Eigen::Vector2d& p_odom_body) const {
    return std::all_of(p_odom_.begin(), p_odom_.end(), [&](const Eigen::Vector2d& p_odom) {
      return (p_odom_body - p_odom).norm() > distance_m;
    });
  }

 private:
  std::deque<Eigen::Vector2d> p_odom_;  ///< the newest last
};

/// Whether the robot gets on on its way home, by how long exploration says that it still is. A
/// drive alone does not tell: back along its own track it leads away from a short cut that is
/// shut, and exploration leads to the short cut again.
class HomewardProgress {
 public:
  static constexpr double kProgressMinM = 1.0;

  /// It has turned home, or turned home again.
  void begin() { *this = {}; }

  /// What exploration says now [m]. Whether it is a metre shorter than ever, or another way at once
  /// after the verdict on the last; then what was refused before lies behind.
  bool note_progress(double path_length_m) {
    const bool shorter = path_length_m < shortest_m_ - kProgressMinM;
    const bool other_path = after_verdict_ && path_length_m > last_m_ + kProgressMinM;
    last_m_ = path_length_m;
    after_verdict_ = false;
    if (!shorter && !other_path) return false;
    shortest_m_ = path_length_m;
    blocked_ = false;
    return true;
  }

  /// A verdict says that this way is shut.
  void mark_blocked() { blocked_ = after_verdict_ = true; }
  /// Without it having got on since: exploration knows no other.
  [[nodiscard]] bool was_blocked() const { return blocked_; }

 private:
  double shortest_m_ = std::numeric_limits<double>::infinity();
  double last_m_ = std::numeric_limits<double>::infinity();
  bool blocked_ = false;
  bool after_verdict_ = false;  ///< what exploration says next
};

}  // namespace adit
