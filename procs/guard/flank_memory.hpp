// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/convex_polygon.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/obstacle_points.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Remembers obstacles beside the vehicle, between its lasers. Each laser scans 90° to either side
/// and nothing behind itself: neither sees a post that the vehicle is passing, and its flank could
/// hit the post in a turn. The last points that a laser has seen there are therefore stored in
/// odom, up to a metre from either flank, one point for each cell of 4 cm, where possible the mean
/// of three beams: of errors of 5 mm 3 mm remain. They are deleted when they come into view again,
/// where the footprint has been, and when the pose jumps. Without a rear laser they are kept up to
/// 3 m behind the vehicle. A spinning lidar sees all around but what is nearer than its least
/// range: there, points are stored that it saw shortly beyond.
class FlankMemory {
 public:
  FlankMemory(const Vehicle& vehicle, const Lasers& lasers);

  void move_to(const Pose2& T_odom_body);

  /// Adds the newest scan of a laser; ignored before the first pose.
  void observe(LaserId laser, const LaserPoints& points);

  /// The remembered points in the body frame at the newest pose; none is in the footprint.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& p_body() const { return p_body_; }

 private:
  using Cell =
      std::pair<double, double>;  ///< integers as double: a pose may be arbitrarily far away

  [[nodiscard]] bool is_in_view_of(LaserId laser, const Eigen::Vector2d& p_body) const;
  [[nodiscard]] bool is_at_view_edge(LaserId laser, const Eigen::Vector2d& p_body) const;
  [[nodiscard]] double from_lidar_m(const Eigen::Vector2d& p_body) const {
    return (p_body - *p_body_lidar_).norm();
  }
  [[nodiscard]] bool is_beside(const Eigen::Vector2d& p_body) const;
  void update_points();

  ConvexPolygon outline_;
  double front_x_m_;
  double rear_x_m_;
  bool has_rear_;
  std::optional<Eigen::Vector2d> p_body_lidar_;  ///< of a spinning lidar
  double range_min_m_;                           ///< of that
  std::optional<Pose2> T_odom_body_;
  std::map<Cell, Eigen::Vector2d> p_odom_;
  std::vector<Eigen::Vector2d> p_body_;
};

}  // namespace adit
