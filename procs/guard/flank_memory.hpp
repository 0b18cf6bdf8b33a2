// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/laser_monitor.hpp"

namespace adit {

/// What stands beside the vehicle, between its lasers. Each looks 90° to either side and sees
/// nothing behind itself, so that a post which the vehicle has begun to pass is seen by neither,
/// and its flank would meet it in a turn. So what a laser sees last is kept in odom while the
/// vehicle goes by: a metre to either side, one point for each cell of a few centimetres. It is
/// forgotten when it comes into sight again, where the vehicle has been itself, and where the pose
/// jumps.
class FlankMemory {
 public:
  FlankMemory(const Vehicle& vehicle, const Lasers& lasers);

  void move_to(const Pose2& T_odom_body);

  /// The newest scan of a laser; nothing is kept before the first pose.
  void observe(LaserId laser, const LaserPoints& points);

  /// In the body frame at the newest pose, none of them in the footprint.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& p_body() const { return p_body_; }

 private:
  using Cell = std::pair<double, double>;  ///< whole numbers: a pose may be anywhere

  [[nodiscard]] bool is_in_view_of(LaserId laser, const Eigen::Vector2d& p_body) const;
  [[nodiscard]] bool is_at_view_edge(LaserId laser, const Eigen::Vector2d& p_body) const;
  [[nodiscard]] bool is_beside(const Eigen::Vector2d& p_body) const;
  void update_points();

  Eigen::Vector2d half_footprint_m_;
  double front_x_m_;
  double rear_x_m_;
  std::optional<Pose2> T_odom_body_;
  std::map<Cell, Eigen::Vector2d> p_odom_;
  std::vector<Eigen::Vector2d> p_body_;
};

}  // namespace adit
