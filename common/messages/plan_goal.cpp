// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/plan_goal.hpp"

#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Kind = PlanGoal::Kind;

static_assert(static_cast<int>(Kind::kAlong) == plan_goal_t::KIND_ALONG);
static_assert(static_cast<int>(Kind::kTo) == plan_goal_t::KIND_TO);

}  // namespace

plan_goal_t to_message(const PlanGoal& goal) {
  plan_goal_t message;
  message.utime = goal.utime;
  message.id = goal.id;
  message.kind = static_cast<std::int8_t>(goal.kind);
  set_pose(goal.T_odom_goal, message.T_odom_goal);
  message.distance_max_m = goal.distance_m;
  return message;
}

Result<PlanGoal> from_message(const plan_goal_t& message) {
  const auto kind = Kind(message.kind);
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (message.id < 0) return Refused{"negative id"};
  if (kind != Kind::kAlong && kind != Kind::kTo) return Refused{"unknown kind"};
  if (!all_finite(message.T_odom_goal)) return Refused{kPoseNotFinite};
  if (!std::isfinite(message.distance_max_m)) return Refused{"distance is not finite"};
  if (message.distance_max_m <= 0.0) return Refused{"distance is not positive"};
  return PlanGoal{message.utime, message.id, kind, pose_from(message.T_odom_goal),
                  message.distance_max_m};
}

}  // namespace adit
