// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/obstacle_points.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/obstacle_check.hpp"

namespace adit {

/// The ground that is known to be free, for motions to a side on which the vehicle is blind: where
/// it has been over the last 60 m, and within 8 m what lay between the laser and the obstacles that
/// it saw. Cells of 0.1 m in odom. All is forgotten when the pose jumps. What comes there
/// afterwards is not noticed: a vehicle with one laser needs its surroundings to itself.
class BlindSideMemory {
 public:
  BlindSideMemory(const Vehicle& vehicle, const LaserMount& laser);

  void move_to(const Pose2& T_odom_body);
  /// Adds a scan; ignored before the first pose, and until the vehicle has moved 5 cm or 3° since
  /// the last one.
  void observe(const LaserPoints& points);

  /// Distance that the body can move along the arc over known ground, up to `within_m` [m]. 0
  /// before the first pose.
  [[nodiscard]] double known_m(const ArcMotion& motion, double within_m) const;

 private:
  void add_footprint();
  void add_line(const Eigen::Vector2d& p_odom_from, const Eigen::Vector2d& p_odom_to);
  void forget_far_cells();
  void forget_old_cells();
  [[nodiscard]] bool is_known(const Pose2& T_odom_body) const;
  [[nodiscard]] bool is_under_body(const Eigen::Vector2d& p_odom) const;

  Vehicle vehicle_;
  LaserMount laser_;
  std::optional<Pose2> T_odom_body_;
  std::optional<Pose2> T_odom_observed_;   ///< at the last scan that was added
  std::optional<Pose2> T_odom_footprint_;  ///< at the last footprint that was added
  Eigen::Vector2d p_odom_pruned_{0.0, 0.0};
  // Only looked up and erased: their order has no effect.
  std::unordered_set<std::int64_t> seen_;
  std::unordered_map<std::int64_t, double> driven_;  ///< with the odometer when it was last driven
  std::deque<std::pair<std::int64_t, double>> driven_in_order_;
  double odometer_m_ = 0.0;
};

}  // namespace adit
