// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The way of the body in odom: how long it is, and its last metres, to go back on.
class OwnTrack {
 public:
  void add(std::int64_t utime, const Pose2& T_odom_body);
  /// A new odom frame: what was driven counts, but nobody can go back on it before it is known
  /// where the new frame lies. Without knowing where the old one lay in map nobody ever can.
  void begin_anew(const std::optional<Pose2>& T_map_odom);
  /// The present odom frame is known to lie there: the way before it leads on from where it begins.
  void tie(const Pose2& T_map_odom);
  /// What was driven before a restart [m].
  void set_travelled(double travelled_m) { travelled_m_ = travelled_m; }

  [[nodiscard]] double travelled_m() const { return travelled_m_; }
  [[nodiscard]] const std::optional<Pose2>& T_odom_body() const { return T_odom_body_; }
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  /// From the body back along the way, this far at most.
  [[nodiscard]] std::vector<Eigen::Vector2d> back(double length_m) const;

 private:
  std::int64_t utime_ = 0;
  std::optional<Pose2> T_odom_body_;
  double travelled_m_ = 0.0;
  std::deque<Eigen::Vector2d> places_;      ///< odom, the newest last
  std::deque<Eigen::Vector2d> before_map_;  ///< the way in odom frames before, until it is tied
};

}  // namespace adit
