// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"

namespace adit {

/// Follows the route to the target as far as possible.
struct FollowRoute {};

/// Follows the route only as far as a path exists. Ground behind a rail or a corner is in shadow
/// from far away; a 3D scan from there observes it.
struct Approach {
  double length_m = 0.0;  ///< along the route to the target
};

/// Drives back over the traversed path and scans from another viewpoint. The ground there carried
/// the robot on the way in, regardless of what the scans show.
struct BackOff {
  /// kRetrace, or kRoute: planned over the observed terrain.
  PlanGoal::Kind kind = PlanGoal::Kind::kRetrace;
  double distance_m = 0.0;
  std::vector<Pose2> path_odom;         ///< T_odom_body, from the present pose backwards
  std::optional<Approach> interrupted;  ///< the approach whose drive failed; GOAL has its route
};

/// Drives onto the traversed path and along it.
struct Rejoin {
  /// kRejoin; kRetrace without terrain of this odom frame; kRoute after planning rejected that.
  PlanGoal::Kind kind = PlanGoal::Kind::kRejoin;
  double distance_m = 0.0;              ///< to the place where the traversed path is left again
  std::vector<Pose2> path_odom;         ///< T_odom_body, from the present pose backwards
  std::optional<Approach> interrupted;  ///< the approach whose drive failed; GOAL has its route
};

/// What the robot does from the plan phase to the end of the execute phase.
using Maneuver = std::variant<FollowRoute, Approach, BackOff, Rejoin>;

/// Where a maneuver starts from and leads to.
struct ManeuverTarget {
  const std::vector<Eigen::Vector2d>& route_odom;  ///< to the target, two points at least
  bool ends_at_home = false;                       ///< the end of the route is the start pose
};

/// The goal of planning for a maneuver. The caller sets time and id.
PlanGoal goal_of(const Maneuver& maneuver, const ManeuverTarget& target);

/// The maneuver that replaces one for which planning rejects to retrace the traversed path: the
/// same, planned over the observed terrain. Empty for one that does not retrace.
std::optional<Maneuver> planned_instead_of_retraced(const Maneuver& maneuver);

/// The approach that a maneuver is, or that it interrupts.
std::optional<Approach> approach_of(const Maneuver& maneuver);

/// Whether the maneuver leaves the route to the target for the traversed path.
bool is_off_route(const Maneuver& maneuver);

/// Whether the maneuver leads away from the target: arrival is no progress.
bool leads_away(const Maneuver& maneuver);

/// Whether the maneuver drives along the traversed path, not planned over the observed terrain.
bool uses_traversed_path(const Maneuver& maneuver);

}  // namespace adit
