// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/maneuver.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace adit {
namespace {

constexpr double kRouteLengthM = 10.0;    // of a path along the route
constexpr double kPlannedRouteM = 12.0;   // of a route over terrain: the range of a 3D scan
constexpr double kRouteEndM = 0.01;       // tolerance of its length
constexpr double kBackOffMinM = 1.0;      // of traversed path behind the robot
constexpr double kLeadsBackMinM = 0.1;    // less is no path back
constexpr double kSharedMinM = 2.5;       // of the route with the traversed path
constexpr double kRejoinM = 6.0;          // at first
constexpr double kRejoinMaxM = 30.0;      // after several rejoins
constexpr double kUnscannedMaxM = 30.0;   // driven along the traversed path between two scans
constexpr double kTransitMinM = 4.0;      // less is not worth a path of its own
constexpr double kTransitHomeMinM = 1.0;  // to the end of the traversed path
constexpr double kTransitEndM = 1.5;      // before the route leaves the traversed path
constexpr double kPoseSpacingM = 0.2;     // of the traversed path
constexpr double kJoinM = 6.0;            // of the route, in which it joins driven ground
constexpr double kJoinMinM = 12.0;        // along the route; a path over a scan is shorter
constexpr double kRejoinViewM = 10.0;     // poses beyond the rejoin length that planning may reach

using GoalKind = PlanGoal::Kind;

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::vector<Eigen::Vector2d> first_part_of(const std::vector<Eigen::Vector2d>& line,
                                           double length_m) {
  std::vector<Eigen::Vector2d> first{line.front()};
  double left_m = length_m;
  for (std::size_t i = 1; i < line.size() && left_m > 0.0; ++i) {
    const Eigen::Vector2d leg = line[i] - line[i - 1];
    const double leg_m = leg.norm();
    first.push_back(leg_m > left_m ? line[i - 1] + left_m / leg_m * leg : line[i]);
    left_m -= leg_m;
  }
  return first;
}

/// By how much the last pose of a path lies beyond the end of its route, along the last leg [m].
double beyond_end_m(const std::vector<Pose2>& path, const std::vector<Eigen::Vector2d>& route) {
  if (path.empty() || route.size() < 2) return 0.0;
  const Eigen::Vector2d along = (route.back() - route[route.size() - 2]).stableNormalized();
  return std::max(0.0, along.dot(path.back().translation() - route.back()));
}

double length_of_line_m(const std::vector<Eigen::Vector2d>& line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

std::vector<Eigen::Vector2d> positions_of(const std::vector<Pose2>& poses) {
  std::vector<Eigen::Vector2d> positions;
  for (const Pose2& pose : poses) positions.push_back(pose.translation());
  return positions;
}

/// The goal with an end point, as any heading is accepted there.
PlanGoal make_goal(GoalKind kind, double distance_m, std::vector<Eigen::Vector2d> route_odom,
                   std::vector<Pose2> path_odom = {}) {
  const Eigen::Vector2d p_odom_end =
      path_odom.empty() ? route_odom.back() : path_odom.back().translation();
  PlanGoal goal;
  goal.kind = kind;
  goal.T_odom_goal = {p_odom_end.x(), p_odom_end.y(), 0.0};
  goal.distance_m = distance_m;
  goal.route_odom = std::move(route_odom);
  goal.traversed_path_odom = std::move(path_odom);
  return goal;
}

}  // namespace

PlanGoal goal_of(const Maneuver& maneuver, const ManeuverTarget& target) {
  const std::vector<Eigen::Vector2d> route_odom =
      target.route_odom.empty() ? target.route_odom
                                : first_part_of(target.route_odom, kPlannedRouteM);
  const bool ends_at_home =
      target.ends_at_home && length_of_line_m(target.route_odom) <= kPlannedRouteM + kRouteEndM;
  const auto route_or = [&](const std::optional<Approach>& interrupted,
                            std::vector<Eigen::Vector2d> otherwise_odom) {
    return interrupted ? first_part_of(target.route_odom, interrupted->length_m)
                       : std::move(otherwise_odom);
  };
  return std::visit(
      Overloaded{[&](const FollowRoute&) {
                   return make_goal(ends_at_home ? GoalKind::kRouteTo : GoalKind::kRoute,
                                    kRouteLengthM, route_odom);
                 },
                 [&](const Approach& approach) {
                   return make_goal(GoalKind::kRouteTo, kRouteLengthM,
                                    first_part_of(target.route_odom, approach.length_m));
                 },
                 [&](const BackOff& back_off) {
                   return make_goal(
                       back_off.kind, back_off.distance_m,
                       route_or(back_off.interrupted, positions_of(back_off.path_odom)),
                       back_off.path_odom);
                 },
                 [&](const Rejoin& rejoin) {
                   return make_goal(rejoin.kind, rejoin.distance_m,
                                    route_or(rejoin.interrupted, route_odom), rejoin.path_odom);
                 }},
      maneuver);
}

std::optional<Maneuver> planned_instead_of_retraced(const Maneuver& maneuver) {
  const auto planned = [](auto retraced) -> std::optional<Maneuver> {
    if (retraced.kind != GoalKind::kRetrace) return std::nullopt;
    retraced.kind = GoalKind::kRoute;
    return retraced;
  };
  if (const auto* back_off = std::get_if<BackOff>(&maneuver)) return planned(*back_off);
  if (const auto* rejoin = std::get_if<Rejoin>(&maneuver)) return planned(*rejoin);
  return std::nullopt;
}

std::optional<Approach> approach_of(const Maneuver& maneuver) {
  return std::visit(
      Overloaded{[](const FollowRoute&) -> std::optional<Approach> { return std::nullopt; },
                 [](const Approach& approach) -> std::optional<Approach> { return approach; },
                 [](const auto& off_route) { return off_route.interrupted; }},
      maneuver);
}

bool is_off_route(const Maneuver& maneuver) {
  return std::holds_alternative<BackOff>(maneuver) || std::holds_alternative<Rejoin>(maneuver);
}

bool leads_away(const Maneuver& maneuver) {
  if (const auto* rejoin = std::get_if<Rejoin>(&maneuver)) return rejoin->kind != GoalKind::kRejoin;
  return std::holds_alternative<BackOff>(maneuver);
}

bool uses_traversed_path(const Maneuver& maneuver) {
  if (const auto* rejoin = std::get_if<Rejoin>(&maneuver)) return rejoin->kind != GoalKind::kRoute;
  const auto* back_off = std::get_if<BackOff>(&maneuver);
  return back_off != nullptr && back_off->kind != GoalKind::kRoute;
}

bool Retracing::leads_back(const TraversedPath& path) {
  return path.back_length_m(kBackOffMinM) > kLeadsBackMinM;
}

bool Retracing::can_back_off(const TraversedPath& path, double distance_m) {
  return path.back_length_m(distance_m) > kBackOffMinM;
}

std::optional<double> Retracing::rejoin_length_m(const TraversedPath& path,
                                                 const std::vector<Eigen::Vector2d>& route_odom,
                                                 bool returning_home) const {
  if (failed_) return std::nullopt;
  if (returning_home) {
    if (!leads_back(path)) return std::nullopt;
    const int steps = 1 + rejoins_ / 2;  // farther at each second attempt
    return std::min(kRejoinM * steps, kRejoinMaxM);
  }
  const double shared_m = path.shared_length_m(route_odom);
  if (shared_m < kSharedMinM) return std::nullopt;
  return std::min(shared_m, kRejoinM);
}

/// The ground has carried the robot, and the guard sees what has changed since.
std::optional<Rejoin> Retracing::transit(const TraversedPath& path,
                                         const std::vector<Eigen::Vector2d>& route_odom,
                                         double unscanned_m, bool ends_at_route_end,
                                         bool may_reverse) const {
  if (failed_) return std::nullopt;
  const auto known = path.known_part(route_odom, may_reverse);
  const double known_m =
      length_of_path_m(known.path_odom) - beyond_end_m(known.path_odom, route_odom);
  const bool to_end =
      ends_at_route_end && known.along_m >= length_of_line_m(route_odom) - kPoseSpacingM;
  const double left_m = kUnscannedMaxM - unscanned_m;
  // The scan for a rest that is shorter than any transit would take longer than its drive.
  const bool in_one = to_end && known_m <= left_m + kTransitMinM;
  const double length_m =
      in_one ? known_m : std::min(to_end ? known_m : known_m - kTransitEndM, left_m);
  if (std::min(length_m, known.along_m) < (in_one ? kTransitHomeMinM : kTransitMinM))
    return std::nullopt;
  return Rejoin{PlanGoal::Kind::kRetrace, length_m, first_part_of(known.path_odom, length_m),
                std::nullopt};
}

std::optional<Rejoin> Retracing::join(const TraversedPath& path,
                                      const std::vector<Eigen::Vector2d>& route_odom,
                                      bool may_reverse, bool is_symmetric) const {
  if (failed_) return std::nullopt;
  const auto known = path.joined_part(route_odom, kJoinM, may_reverse, is_symmetric);
  const double length_m =
      std::min(length_of_path_m(known.path_odom) - kTransitEndM, kUnscannedMaxM);
  if (known.along_m < kJoinMinM || length_m < kTransitMinM) return std::nullopt;
  return Rejoin{PlanGoal::Kind::kRejoin, length_m, first_part_of(known.path_odom, length_m),
                std::nullopt, true};
}

BackOff Retracing::back_off(const TraversedPath& path, double distance_m,
                            const Maneuver& present) const {
  const auto kind = failed_ ? PlanGoal::Kind::kRoute : PlanGoal::Kind::kRetrace;
  return {kind, distance_m, path.back(distance_m), approach_of(present)};
}

std::optional<BackOff> Retracing::withdrawal(const TraversedPath& path, double distance_m) {
  std::vector<Pose2> recent = path.recent(distance_m);
  if (length_of_path_m(recent) < kBackOffMinM) return std::nullopt;
  return BackOff{PlanGoal::Kind::kRetrace, distance_m, std::move(recent), std::nullopt};
}

Rejoin Retracing::rejoin(const TraversedPath& path, double length_m, bool has_terrain,
                         const Maneuver& present) {
  ++rejoins_;
  const auto kind = has_terrain ? PlanGoal::Kind::kRejoin : PlanGoal::Kind::kRetrace;
  return {kind, length_m, path.poses_back_within(length_m + kRejoinViewM), approach_of(present)};
}

}  // namespace adit
