// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/exploration.hpp"
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

/// Where targets were first rejected, and the path to there, in odom. A robot that returns to such
/// a place, or ends short of it, has made no progress. Only the newest are stored, more than any
/// part of a mine has.
class RejectedPlaces {
 public:
  static constexpr std::size_t kPlacesStoredMax = 20'000;  // of 40 for each rejection

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
  /// `recent`: T_odom_body at the rejection and on the last metres before.
  void add_rejection(const std::vector<Pose2>& recent) {
    for (const Pose2& T_odom_body : recent) rejected_.add(T_odom_body.translation());
  }

  /// A path has ended. Returns whether the robot is stuck, see PathEnds.
  [[nodiscard]] bool add_path_end(const Eigen::Vector2d& p_odom_body) {
    return path_ends_.add_and_check_stuck(p_odom_body);
  }

  /// Whether the drive led to a place where no target was rejected before, and not only back on the
  /// path to one.
  [[nodiscard]] bool is_beyond_rejections(const TraversedPath& path) const {
    return path.distance_travelled_m() - drive_start_m_ >= kProgressMinM && path.T_odom_body() &&
           rejected_.all_farther_than(kProgressMinM, path.T_odom_body()->translation());
  }

 private:
  RejectedPlaces rejected_;
  PathEnds path_ends_;
  double drive_start_m_ = 0.0;
};

/// Detects progress of the return home, by the path length to home that exploration reports. A
/// completed drive is no measure: along the traversed path it leads away from a blocked short cut,
/// and the next route of exploration leads to the short cut again.
class HomewardProgress {
 public:
  static constexpr double kProgressMinM = 1.0;

  void reset() { *this = {}; }

  /// Takes the path length that exploration reports now [m]. Returns true if it is 1 m shorter than
  /// ever, or if exploration reports another path directly after a verdict: earlier rejections are
  /// behind the robot then.
  bool add(double path_length_m) {
    const bool shorter = path_length_m < shortest_m_ - kProgressMinM;
    const bool other_path = after_verdict_ && path_length_m > last_m_ + kProgressMinM;
    last_m_ = path_length_m;
    after_verdict_ = false;
    if (!shorter && !other_path) return false;
    shortest_m_ = path_length_m;
    blocked_ = false;
    return true;
  }

  /// The mission reported the path as blocked.
  void mark_blocked() { blocked_ = after_verdict_ = true; }
  /// Whether no progress was made since then: exploration has no other path.
  [[nodiscard]] bool is_blocked() const { return blocked_; }

 private:
  double shortest_m_ = std::numeric_limits<double>::infinity();
  double last_m_ = std::numeric_limits<double>::infinity();
  bool blocked_ = false;
  bool after_verdict_ = false;  ///< the next report follows a verdict
};

/// The end of the return home: the start pose as the goal, and when the robot is close enough.
class HomeArrival {
 public:
  HomeArrival(double tolerance_m, int tries_max)
      : tolerance_m_(tolerance_m), tries_max_(tries_max) {}

  /// Takes home as the end of the route if a report of exploration leads that far.
  void set_route(const ExplorationReport& report) {
    p_odom_home_ = home_at_end_of(report);
    if (report.decision.kind != ExplorationDecision::Kind::kHome) tries_ = 0;
  }
  /// The route ends elsewhere, or its odom frame is no longer valid.
  void clear() { p_odom_home_.reset(); }

  [[nodiscard]] bool is_end_of_route() const { return p_odom_home_.has_value(); }
  /// Whether the robot is within the tolerance. False if home is not the end of the route.
  [[nodiscard]] bool is_near(const std::optional<Pose2>& T_odom_body) const {
    return p_odom_home_ && T_odom_body && distance_m(*T_odom_body) <= tolerance_m_;
  }
  /// Distance to home [m]. Only if it is the end of the route.
  [[nodiscard]] double distance_m(const Pose2& T_odom_body) const {
    return (T_odom_body.translation() - *p_odom_home_).norm();
  }
  /// Counts a try to get nearer within the tolerance. Returns whether all tries are used.
  bool count_try() { return ++tries_ > tries_max_; }

 private:
  static constexpr double kSamePointM = 0.01;

  /// Empty if the route of the report ends elsewhere. Frame odom.
  [[nodiscard]] static std::optional<Eigen::Vector2d> home_at_end_of(
      const ExplorationReport& report) {
    if (report.decision.kind != ExplorationDecision::Kind::kHome || report.route_odom.empty()) {
      return std::nullopt;
    }
    const Eigen::Vector2d p_odom_goal = report.T_odom_goal.translation();
    if ((report.route_odom.back() - p_odom_goal).norm() > kSamePointM) return std::nullopt;
    return p_odom_goal;
  }

  double tolerance_m_;
  int tries_max_;
  std::optional<Eigen::Vector2d> p_odom_home_;
  int tries_ = 0;
};

}  // namespace adit
