// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/navigation.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "common/messages/fields/navigation_fields.hpp"
#include "common/messages/fragments.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

static_assert(static_cast<int>(PlanGoal::Kind::kAlong) == plan_goal_t::KIND_ALONG);
static_assert(static_cast<int>(PlanGoal::Kind::kToPose) == plan_goal_t::KIND_TO_POSE);
static_assert(static_cast<int>(PlanGoal::Kind::kRoute) == plan_goal_t::KIND_ROUTE);
static_assert(static_cast<int>(PlanGoal::Kind::kRetrace) == plan_goal_t::KIND_RETRACE);
static_assert(static_cast<int>(PlanGoal::Kind::kRouteTo) == plan_goal_t::KIND_ROUTE_TO);
static_assert(static_cast<int>(PlanGoal::Kind::kRejoin) == plan_goal_t::KIND_REJOIN);

std::string_view rejection_reason(const plan_goal_t& message) {
  const auto kind = PlanGoal::Kind(message.kind);
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  const auto& route = message.route_odom;
  const auto& traversed_path = message.traversed_path_odom;
  const bool on_route = kind == PlanGoal::Kind::kRoute || kind == PlanGoal::Kind::kRouteTo;
  const bool on_traversed_path =
      kind == PlanGoal::Kind::kRetrace || kind == PlanGoal::Kind::kRejoin;
  if (route.size() > PlanGoal::kPointsMax || (on_route && route.size() < 2)) {
    return "invalid route";
  }
  if (traversed_path.size() > PlanGoal::kPointsMax ||
      (on_traversed_path && traversed_path.size() < 2))
    return "invalid traversed path";
  return {};
}

using Reason = BlockingCell::Reason;

static_assert(static_cast<int>(PlanOutcome::kFound) == planned_path_t::OUTCOME_FOUND);
static_assert(static_cast<int>(PlanOutcome::kStartBlocked) ==
              planned_path_t::OUTCOME_START_BLOCKED);
static_assert(static_cast<int>(PlanOutcome::kBlocked) == planned_path_t::OUTCOME_BLOCKED);
static_assert(static_cast<int>(PlanOutcome::kUnknown) == planned_path_t::OUTCOME_UNKNOWN);
static_assert(static_cast<int>(PlanOutcome::kSearchLimit) == planned_path_t::OUTCOME_SEARCH_LIMIT);
static_assert(static_cast<int>(PlanOutcome::kNarrow) == planned_path_t::OUTCOME_NARROW);
static_assert(static_cast<int>(Reason::kStep) == blocking_cell_t::REASON_STEP);
static_assert(static_cast<int>(Reason::kBelly) == blocking_cell_t::REASON_BELLY);
static_assert(static_cast<int>(Reason::kRoof) == blocking_cell_t::REASON_ROOF);
static_assert(static_cast<int>(Reason::kUnknown) == blocking_cell_t::REASON_UNKNOWN);
static_assert(static_cast<int>(Reason::kWater) == blocking_cell_t::REASON_WATER);
static_assert(static_cast<int>(Reason::kSlope) == blocking_cell_t::REASON_SLOPE);
static_assert(static_cast<int>(Reason::kDrop) == blocking_cell_t::REASON_DROP);

constexpr std::size_t kBlockingCellBytes = 3 * sizeof(double) + 1;  // encoded size

path_point_t to_message(const PathPoint& point) {
  path_point_t message;
  set_pose(point.T_odom_body, message.T_odom_body);
  message.curvature_1_m = point.curvature_1_m;
  message.reverse = static_cast<std::int8_t>(point.reverse);
  message.clearance_m = point.clearance_m;
  message.cost = point.cost;
  return message;
}

PathPoint point_from(const path_point_t& message) {
  return {pose_from(message.T_odom_body), message.curvature_1_m, message.reverse != 0,
          message.clearance_m, message.cost};
}

blocking_cell_t to_message(const BlockingCell& cell) {
  blocking_cell_t message;
  message.p_odom[0] = cell.p_odom.x();
  message.p_odom[1] = cell.p_odom.y();
  message.reason = static_cast<std::int8_t>(cell.reason);
  message.height_m = cell.height_m;
  return message;
}

BlockingCell cell_from(const blocking_cell_t& message) {
  return {{message.p_odom[0], message.p_odom[1]}, Reason(message.reason), message.height_m};
}

std::string_view rejection_reason(const planned_path_t& message) {
  const auto outcome = PlanOutcome(message.outcome);
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  const bool found = outcome == PlanOutcome::kFound;
  if (found && message.points.empty()) return "path without points";
  if (!found && !message.points.empty()) return "points without a path";
  if (message.n_blocking_found < message.n_blocking)
    return "cell count below the number of blocking cells";
  return {};
}

/// Adds the blocking cells that keep the message within kFragmentBytes after its points.
void add_blocking_cells(const std::vector<BlockingCell>& blocking, planned_path_t& message) {
  message.n_blocking_found = static_cast<std::int32_t>(blocking.size());
  message.n_blocking = 0;
  const auto bytes_used = static_cast<std::size_t>(message.getEncodedSize());
  const std::size_t room =
      (kFragmentBytes - std::min(bytes_used, kFragmentBytes)) / kBlockingCellBytes;
  const std::size_t n = std::min(blocking.size(), room);
  for (std::size_t i = 0; i < n; ++i) message.blocking.push_back(to_message(blocking[i]));
  message.n_blocking = static_cast<std::int32_t>(n);
}

static_assert(static_cast<int>(DrivingState::Kind::kIdle) == driving_state_t::STATE_IDLE);
static_assert(static_cast<int>(DrivingState::Kind::kDriving) == driving_state_t::STATE_DRIVING);
static_assert(static_cast<int>(DrivingState::Kind::kWaiting) == driving_state_t::STATE_WAITING);
static_assert(static_cast<int>(DrivingState::Kind::kArrived) == driving_state_t::STATE_ARRIVED);
static_assert(static_cast<int>(DrivingState::Kind::kFailed) == driving_state_t::STATE_FAILED);

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
  message.n_traversed_path = static_cast<std::int32_t>(goal.traversed_path_odom.size());
  for (const Pose2& pose : goal.traversed_path_odom) {
    message.traversed_path_odom.push_back({pose.x, pose.y, pose.theta});
  }
  return message;
}

Result<PlanGoal> from_message(const plan_goal_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  PlanGoal goal{message.utime,
                message.id,
                PlanGoal::Kind(message.kind),
                pose_from(message.T_odom_goal),
                message.distance_max_m,
                {},
                {}};
  for (const std::vector<double>& p : message.route_odom) goal.route_odom.emplace_back(p[0], p[1]);
  for (const std::vector<double>& pose : message.traversed_path_odom) {
    goal.traversed_path_odom.push_back({pose[0], pose[1], pose[2]});
  }
  return goal;
}

planned_path_t to_message(const PlannedPath& path) {
  planned_path_t message;
  message.utime = path.utime;
  message.id = path.id;
  message.outcome = static_cast<std::int8_t>(path.outcome);
  message.reason = path.reason;
  message.reached_m = path.reached_m;
  message.n_points = static_cast<std::int32_t>(path.points.size());
  for (const PathPoint& point : path.points) message.points.push_back(to_message(point));
  add_blocking_cells(path.blocking, message);
  return message;
}

Result<PlannedPath> from_message(const planned_path_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  PlannedPath path;
  path.utime = message.utime;
  path.id = message.id;
  path.outcome = PlanOutcome(message.outcome);
  path.reason = message.reason;
  path.reached_m = message.reached_m;
  for (const path_point_t& point : message.points) {
    path.points.push_back(point_from(point));
  }
  for (const blocking_cell_t& cell : message.blocking) {
    path.blocking.push_back(cell_from(cell));
  }
  return path;
}

driving_state_t to_message(const DrivingState& state) {
  driving_state_t message;
  message.utime = state.utime;
  message.path_id = state.path_id;
  message.state = static_cast<std::int8_t>(state.kind);
  message.reason = state.reason;
  message.progress_m = state.progress_m;
  message.remaining_m = state.remaining_m;
  message.lateral_error_m = state.error.lateral_m;
  message.heading_error_rad = state.error.heading_rad;
  return message;
}

Result<DrivingState> from_message(const driving_state_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return DrivingState{message.utime,
                      message.path_id,
                      DrivingState::Kind(message.state),
                      message.reason,
                      message.progress_m,
                      message.remaining_m,
                      {message.lateral_error_m, message.heading_error_rad}};
}

drive_command_t to_message(const DriveCommand& command) {
  drive_command_t message;
  message.utime = command.utime;
  message.speed_m_s = command.speed_m_s;
  message.curvature_1_m = command.curvature_1_m;
  return message;
}

Result<DriveCommand> from_message(const drive_command_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return DriveCommand{message.utime, message.speed_m_s, message.curvature_1_m};
}

stop_t to_message(const StopOrder& order) {
  stop_t message;
  message.utime = order.utime;
  message.stopped = static_cast<std::int8_t>(order.stopped);
  message.reason = order.reason;
  return message;
}

Result<StopOrder> from_message(const stop_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return StopOrder{message.utime, message.stopped != 0, message.reason};
}

vehicle_state_t to_message(const VehicleState& state) {
  vehicle_state_t message;
  message.utime = state.utime;
  message.speed_m_s = state.speed_m_s;
  message.curvature_1_m = state.curvature_1_m;
  message.battery_share = state.battery_share;
  message.stopped = static_cast<std::int8_t>(state.stopped);
  message.expired = static_cast<std::int8_t>(state.expired);
  return message;
}

Result<VehicleState> from_message(const vehicle_state_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return VehicleState{message.utime,         message.speed_m_s,    message.curvature_1_m,
                      message.battery_share, message.stopped != 0, message.expired != 0};
}

}  // namespace adit
