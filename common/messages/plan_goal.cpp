// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/plan_goal.hpp"

#include <algorithm>

#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Kind = PlanGoal::Kind;

static_assert(static_cast<int>(Kind::kAlong) == plan_goal_t::KIND_ALONG);
static_assert(static_cast<int>(Kind::kTo) == plan_goal_t::KIND_TO);
static_assert(static_cast<int>(Kind::kRoute) == plan_goal_t::KIND_ROUTE);
static_assert(static_cast<int>(Kind::kRetrace) == plan_goal_t::KIND_RETRACE);
static_assert(static_cast<int>(Kind::kRouteTo) == plan_goal_t::KIND_ROUTE_TO);
static_assert(static_cast<int>(Kind::kRejoin) == plan_goal_t::KIND_REJOIN);

bool are_finite(const std::vector<std::vector<double>>& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [](const std::vector<double>& row) { return all_finite(row); });
}

std::string_view reason_to_refuse(const plan_goal_t& message) {
  const auto kind = Kind(message.kind);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id < 0) return "negative id";
  if (kind < Kind::kAlong || kind > Kind::kRejoin) return "unknown kind";
  if (!all_finite(message.T_odom_goal)) return kPoseNotFinite;
  if (!std::isfinite(message.distance_max_m)) return "distance is not finite";
  if (message.distance_max_m <= 0.0) return "distance is not positive";
  const auto& route = message.route_odom;
  const auto& track = message.track_odom;
  const bool on_route = kind == Kind::kRoute || kind == Kind::kRouteTo;
  const bool on_track = kind == Kind::kRetrace || kind == Kind::kRejoin;
  if (route.size() > PlanGoal::kPlacesMax || (on_route && route.size() < 2)) {
    return "route that is none";
  }
  if (track.size() > PlanGoal::kPlacesMax || (on_track && track.size() < 2))
    return "track that is none";
  if (!are_finite(route)) return "route that is not finite";
  return are_finite(track) ? std::string_view{} : "track that is not finite";
}

}  // namespace

plan_goal_t to_message(const PlanGoal& goal) {
  plan_goal_t message;
  message.utime = goal.utime;
  message.id = goal.id;
  message.kind = static_cast<std::int8_t>(goal.kind);
  set_pose(goal.T_odom_goal, message.T_odom_goal);
  message.distance_max_m = goal.distance_m;
  message.n_route = static_cast<std::int32_t>(goal.route_odom.size());
  for (const Eigen::Vector2d& p : goal.route_odom) message.route_odom.push_back({p.x(), p.y()});
  message.n_track = static_cast<std::int32_t>(goal.track_odom.size());
  for (const Pose2& pose : goal.track_odom) {
    message.track_odom.push_back({pose.x, pose.y, pose.theta});
  }
  return message;
}

Result<PlanGoal> from_message(const plan_goal_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  PlanGoal goal{message.utime,
                message.id,
                Kind(message.kind),
                pose_from(message.T_odom_goal),
                message.distance_max_m,
                {},
                {}};
  for (const std::vector<double>& p : message.route_odom) goal.route_odom.emplace_back(p[0], p[1]);
  for (const std::vector<double>& pose : message.track_odom) {
    goal.track_odom.push_back({pose[0], pose[1], pose[2]});
  }
  return goal;
}

}  // namespace adit
