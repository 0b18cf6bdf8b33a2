// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include <Eigen/Core>

#include "procs/mission/traversed_path.hpp"

namespace adit {

/// Where the last paths ended, in odom. A path that was found and driven may still lead nowhere:
/// exploration may request the same place again and again.
class PathEnds {
 public:
  /// Paths in a row. A turn in a tunnel takes three.
  static constexpr std::size_t kSamePlaceMax = 6;
  static constexpr double kSamePlaceM = 1.0;

  /// Returns whether this path and those before it ended at one place, and restarts the count then.
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

/// Where targets were first rejected, in odom. A robot that returns to such a place has made no
/// progress. Only the newest are stored, more than any part of a mine has.
class RejectedPlaces {
 public:
  static constexpr std::size_t kPlacesStoredMax = 500;

  void add(const Eigen::Vector2d& p_odom) {
    p_odom_.push_back(p_odom);
    if (p_odom_.size() > kPlacesStoredMax) p_odom_.pop_front();
  }

  [[nodiscard]] bool all_farther_than(double distance_m, const Eigen::Vector2d& p_odom_body) const {
    return std::all_of(p_odom_.begin(), p_odom_.end(), [&](const Eigen::Vector2d& p_odom) {
      return (p_odom_body - p_odom).norm() > distance_m;
    });
  }

 private:
  std::deque<Eigen::Vector2d> p_odom_;  ///< the newest last
};

/// Detects progress of drives into the mine. For the return home, see HomewardProgress.
class ProgressChecker {
 public:
  static constexpr double kProgressMinM = 1.0;

  /// Deletes the places, which lie in an odom frame that is no longer valid.
  void reset_odom() {
    rejected_ = {};
    path_ends_ = {};
  }

  /// `distance_travelled_m`: of the mission, when a drive begins.
  void begin_drive(double distance_travelled_m) { drive_start_m_ = distance_travelled_m; }
  void add_rejection(const Eigen::Vector2d& p_odom_body) { rejected_.add(p_odom_body); }

  /// A path has ended. Returns whether the robot is stuck, see PathEnds.
  [[nodiscard]] bool add_path_end(const Eigen::Vector2d& p_odom_body) {
    return path_ends_.add_and_check_stuck(p_odom_body);
  }

  /// Whether the drive led to a place where no target was rejected before.
  [[nodiscard]] bool is_beyond_rejections(const TraversedPath& path) const {
    return path.distance_travelled_m() - drive_start_m_ >= kProgressMinM && path.T_odom_body() &&
           rejected_.all_farther_than(kProgressMinM, path.T_odom_body()->translation());
  }

 private:
  RejectedPlaces rejected_;
  PathEnds path_ends_;
  double drive_start_m_ = 0.0;
};

}  // namespace adit
