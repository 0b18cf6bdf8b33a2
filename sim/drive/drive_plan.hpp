// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "sim/drive/waypoint_file.hpp"

namespace adit {

/// A line of straight legs in the plan, frame `world`. Places on it count in metres from its start;
/// behind the end it goes on straight.
class WaypointPath {
 public:
  /// At least two points, no two neighbours the same.
  explicit WaypointPath(std::vector<Eigen::Vector2d> points);

  [[nodiscard]] double length_m() const { return starts_m_.back(); }
  [[nodiscard]] Eigen::Vector2d at(double s_m) const;
  /// The leg at a place, from 0; at a corner the one that follows.
  [[nodiscard]] std::size_t leg(double s_m) const;
  [[nodiscard]] double heading_rad(std::size_t leg) const;
  /// Of the place nearest to a point, among those between two places of the way.
  [[nodiscard]] double nearest_m(const Eigen::Vector2d& p_world, double from_m, double to_m) const;

 private:
  [[nodiscard]] Eigen::Vector2d direction(std::size_t leg) const;

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> starts_m_;  ///< of each leg, and the end
};

/// Legs that are driven in one direction, to a stand at the end.
struct DriveLegs {
  WaypointPath path;
  std::vector<double> speeds_m_s;  ///< of the legs
  bool reverse = false;
};

/// How waypoints are to be driven through.
struct DrivePlanParams {
  double speed_m_s = 0.0;      ///< where a waypoint says nothing else
  double speed_max_m_s = 0.0;  ///< whatever it says
  bool reverse = false;        ///< back up to waypoints within 45° of straight back
};

/// The way from where the body is through all waypoints in order, cut where the direction of
/// driving changes. Waypoints less than a millimetre from the one before are left out.
std::vector<DriveLegs> plan_drive(const std::vector<Waypoint>& waypoints, const Pose2& T_world_body,
                                  const DrivePlanParams& params);

}  // namespace adit
