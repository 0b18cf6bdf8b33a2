// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

/// Follows the route to the target as far as possible.
struct FollowRoute {};

/// Follows the route only as far as a path exists. Ground behind a rail or a corner is in shadow
/// from far away; a 3D scan from there observes it.
struct Approach {
  double length_m = 0.0;  ///< along the route to the target
};

/// Drives back over the traversed path and scans from another viewpoint. That ground has carried
/// the robot before, regardless of what the scans show.
struct BackOff {
  /// kRetrace, or kRoute: planned over the observed terrain.
  PlanGoal::Kind kind = PlanGoal::Kind::kRetrace;
  double distance_m = 0.0;
  std::vector<Pose2> path_odom;         ///< T_odom_body, from the present pose backwards
  std::optional<Approach> interrupted;  ///< the approach whose drive failed; GOAL has its route
};

/// Drives onto ground that the robot has driven and along it: the traversed path back, or a path
/// over DrivenGraph.
struct Rejoin {
  /// kRejoin; kRetrace without terrain of this odom frame; kRoute after planning rejected that.
  PlanGoal::Kind kind = PlanGoal::Kind::kRejoin;
  double distance_m = 0.0;              ///< along that ground at most
  std::vector<Pose2> path_odom;         ///< T_odom_body, the nearest first
  std::optional<Approach> interrupted;  ///< the approach whose drive failed; GOAL has its route
  bool is_short_cut = false;            ///< without a path onto it the robot follows its route
};

/// The maneuver of the phases plan and execute.
using Maneuver = std::variant<FollowRoute, Approach, BackOff, Rejoin>;

/// Where a maneuver leads.
struct ManeuverTarget {
  const std::vector<Eigen::Vector2d>& route_odom;  ///< to the target, two points at least
  bool ends_at_home = false;                       ///< the end of the route is the start pose
};

/// The goal of planning for a maneuver. The caller sets time and id.
PlanGoal goal_of(const Maneuver& maneuver, const ManeuverTarget& target);

/// The fallback when planning rejects a maneuver that retraces the traversed path: the same
/// maneuver, planned over the observed terrain. Empty for other maneuvers.
std::optional<Maneuver> planned_instead_of_retraced(const Maneuver& maneuver);

/// The approach that a maneuver is, or that it interrupts.
std::optional<Approach> approach_of(const Maneuver& maneuver);

/// Whether the maneuver leaves the route to the target for the traversed path.
bool is_off_route(const Maneuver& maneuver);

/// Whether the maneuver leads away from the target: arrival is no progress.
bool leads_away(const Maneuver& maneuver);

/// Whether the maneuver drives along the traversed path, not planned over the observed terrain.
bool uses_traversed_path(const Maneuver& maneuver);

/// Chooses how far the robot drives along the traversed path. After a failed drive along it that is
/// no option until a drive arrives, or until no planned path is found either.
class Retracing {
 public:
  /// Poses of another odom frame are invalid.
  void reset() { *this = {}; }
  /// The robot made progress, or the target changed.
  void note_progress() { rejoins_ = 0; }
  void note_drive(bool failed) { failed_ = failed; }
  void forget_failed_drive() { failed_ = false; }

  /// Whether the robot can go back at all.
  [[nodiscard]] static bool leads_back(const TraversedPath& path);
  [[nodiscard]] static bool can_back_off(const TraversedPath& path, double distance_m);

  /// Back over what the robot drove last, on the return into the mine, to approach a place once
  /// more in which it is stuck; nothing if that is less than a metre.
  [[nodiscard]] static std::optional<BackOff> withdrawal(const TraversedPath& path,
                                                         double distance_m);

  /// Length of a rejoin; empty if the traversed path does not lead to the target. On the return
  /// home it always does, if by a detour; the length grows with the number of rejoins.
  [[nodiscard]] std::optional<double> rejoin_length_m(
      const TraversedPath& path, const std::vector<Eigen::Vector2d>& route_odom,
      bool returning_home) const;

  /// Drives along the part of a route that the robot has driven before, pose by pose and without a
  /// new 3D scan; empty if it must scan here. `unscanned_m`: driven since the last scan.
  /// `ends_at_route_end`: no ground beyond the end of the route is needed. `may_reverse`: the robot
  /// sees behind itself.
  [[nodiscard]] std::optional<Rejoin> transit(const TraversedPath& path,
                                              const std::vector<Eigen::Vector2d>& route_odom,
                                              double unscanned_m, bool ends_at_route_end,
                                              bool may_reverse) const;

  /// After a 3D scan: gets over its terrain onto ground that the robot has driven and on along it;
  /// empty if it was not driven farther than a path over the scan leads.
  [[nodiscard]] std::optional<Rejoin> join(const TraversedPath& path,
                                           const std::vector<Eigen::Vector2d>& route_odom,
                                           bool may_reverse, bool is_symmetric) const;

  /// `present`: the maneuver that is interrupted.
  [[nodiscard]] BackOff back_off(const TraversedPath& path, double distance_m,
                                 const Maneuver& present) const;
  /// `has_terrain`: of the present odom frame. Without it, the path is retraced pose by pose.
  [[nodiscard]] Rejoin rejoin(const TraversedPath& path, double length_m, bool has_terrain,
                              const Maneuver& present);

 private:
  bool failed_ = false;  ///< the last drive along the traversed path
  int rejoins_ = 0;      ///< since progress was made
};

}  // namespace adit
