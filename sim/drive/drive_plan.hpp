// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "sim/drive/waypoint_file.hpp"

namespace adit {

/// A polyline in the plan, frame `world`, parametrised by the distance from its start [m]. It
/// continues straight beyond its end.
class WaypointPath {
 public:
  /// At least two points; consecutive points must differ.
  explicit WaypointPath(std::vector<Eigen::Vector2d> points);

  [[nodiscard]] double length_m() const { return starts_m_.back(); }
  [[nodiscard]] Eigen::Vector2d at(double s_m) const;
  /// Index of the leg at a distance; at a corner, that of the next leg.
  [[nodiscard]] std::size_t leg(double s_m) const;
  [[nodiscard]] double heading_rad(std::size_t leg) const;
  /// Distance along the path of its point nearest to `p_world`, searched between two distances.
  [[nodiscard]] double nearest_m(const Eigen::Vector2d& p_world, double from_m, double to_m) const;

 private:
  [[nodiscard]] Eigen::Vector2d direction(std::size_t leg) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> starts_m_;  ///< where each leg starts, and the length
};

/// Legs driven in one direction. The vehicle stops at the end.
struct DriveLegs {
  WaypointPath path;
  std::vector<double> speeds_m_s;  ///< one for each leg
  bool reverse = false;
};

/// Parameters of plan_drive().
struct DrivePlanParams {
  double speed_m_s = 0.0;      ///< of waypoints without a speed
  double speed_max_m_s = 0.0;  ///< limit for all waypoints
  bool reverse = false;        ///< back up to waypoints within 45° of straight back
};

/// Plans the path from the pose of the body through all waypoints in order, split where the driving
/// direction changes. Waypoints less than 1 mm from the previous one are ignored.
std::vector<DriveLegs> plan_drive(const std::vector<Waypoint>& waypoints, const Pose2& T_world_body,
                                  const DrivePlanParams& params);

}  // namespace adit
