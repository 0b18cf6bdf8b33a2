// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/exploration.hpp"

namespace adit {

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
  void set_route(const ExplorationReport& report);
  /// The route ends elsewhere, or its odom frame is no longer valid.
  void clear() { p_odom_home_.reset(); }

  [[nodiscard]] bool is_end_of_route() const { return p_odom_home_.has_value(); }
  /// Whether the robot is within the tolerance. False if home is not the end of the route.
  [[nodiscard]] bool is_near(const std::optional<Pose2>& T_odom_body) const;
  /// Distance to home [m]. Only if it is the end of the route.
  [[nodiscard]] double distance_m(const Pose2& T_odom_body) const;
  /// Counts a try to get nearer within the tolerance. Returns whether all tries are used.
  bool count_try() { return ++tries_ > tries_max_; }

 private:
  double tolerance_m_;
  int tries_max_;
  std::optional<Eigen::Vector2d> p_odom_home_;
  int tries_ = 0;
};

}  // namespace adit
