// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/planned_path.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "common/messages/pieces.hpp"
#include "common/messages/planar.hpp"

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

static_assert(static_cast<int>(PlanOutcome::kFound) == planned_path_t::OUTCOME_FOUND);
static_assert(static_cast<int>(PlanOutcome::kStartBlocked) ==
              planned_path_t::OUTCOME_START_BLOCKED);
static_assert(static_cast<int>(PlanOutcome::kBlocked) == planned_path_t::OUTCOME_BLOCKED);
static_assert(static_cast<int>(PlanOutcome::kUnknown) == planned_path_t::OUTCOME_UNKNOWN);
static_assert(static_cast<int>(PlanOutcome::kGaveUp) == planned_path_t::OUTCOME_GAVE_UP);
static_assert(static_cast<int>(PlanOutcome::kNarrow) == planned_path_t::OUTCOME_NARROW);
static_assert(static_cast<int>(Reason::kStep) == blocking_cell_t::REASON_STEP);
static_assert(static_cast<int>(Reason::kBelly) == blocking_cell_t::REASON_BELLY);
static_assert(static_cast<int>(Reason::kRoof) == blocking_cell_t::REASON_ROOF);
static_assert(static_cast<int>(Reason::kUnknown) == blocking_cell_t::REASON_UNKNOWN);
static_assert(static_cast<int>(Reason::kWater) == blocking_cell_t::REASON_WATER);
static_assert(static_cast<int>(Reason::kSlope) == blocking_cell_t::REASON_SLOPE);
static_assert(static_cast<int>(Reason::kDrop) == blocking_cell_t::REASON_DROP);

constexpr std::size_t kBlockingCellBytes = 3 * sizeof(double) + 1;  // on the wire

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

std::string_view reason_to_refuse(const path_point_t& message) {
  if (!all_finite(message.T_odom_body)) return kPoseNotFinite;
  if (!std::isfinite(message.curvature_1_m)) return "curvature is not finite";
  if (std::isnan(message.clearance_m)) return "clearance is no number";
  if (!std::isfinite(message.cost)) return "cost is not finite";
  return {};
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

std::string_view reason_to_refuse(const blocking_cell_t& message) {
  const auto reason = Reason(message.reason);
  if (!all_finite(message.p_odom)) return "cell at a place that is not finite";
  if (reason < Reason::kStep || reason > Reason::kDrop) return "cell of an unknown reason";
  return {};
}

std::string_view reason_to_refuse(const planned_path_t& message) {
  const auto outcome = PlanOutcome(message.outcome);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id < 0) return "negative id";
  if (outcome < PlanOutcome::kFound || outcome > PlanOutcome::kNarrow) return "unknown outcome";
  if (!std::isfinite(message.reached_m)) return "progress is not finite";
  const bool found = outcome == PlanOutcome::kFound;
  if (found && message.points.empty()) return "path without points";
  if (!found && !message.points.empty()) return "points without a path";
  if (message.n_blocking_found < message.n_blocking) return "fewer blocking cells than are there";
  return {};
}

/// Whose encoding is no larger than a piece, where the points leave that much room.
void add_blocking(const std::vector<BlockingCell>& blocking, planned_path_t& message) {
  message.n_blocking_found = static_cast<std::int32_t>(blocking.size());
  message.n_blocking = 0;
  const auto taken = static_cast<std::size_t>(message.getEncodedSize());
  const std::size_t room = (kPieceBytes - std::min(taken, kPieceBytes)) / kBlockingCellBytes;
  const std::size_t n = std::min(blocking.size(), room);
  for (std::size_t i = 0; i < n; ++i) message.blocking.push_back(to_message(blocking[i]));
  message.n_blocking = static_cast<std::int32_t>(n);
}

}  // namespace

planned_path_t to_message(const PlannedPath& path) {
  planned_path_t message;
  message.utime = path.utime;
  message.id = path.id;
  message.outcome = static_cast<std::int8_t>(path.outcome);
  message.reason = path.reason;
  message.reached_m = path.reached_m;
  message.n_points = static_cast<std::int32_t>(path.points.size());
  for (const PathPoint& point : path.points) message.points.push_back(to_message(point));
  add_blocking(path.blocking, message);
  return message;
}

Result<PlannedPath> from_message(const planned_path_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  PlannedPath path;
  path.utime = message.utime;
  path.id = message.id;
  path.outcome = PlanOutcome(message.outcome);
  path.reason = message.reason;
  path.reached_m = message.reached_m;
  for (const path_point_t& point : message.points) {
    if (const auto reason = reason_to_refuse(point); !reason.empty()) return Refused{reason};
    path.points.push_back(point_from(point));
  }
  for (const blocking_cell_t& cell : message.blocking) {
    if (const auto reason = reason_to_refuse(cell); !reason.empty()) return Refused{reason};
    path.blocking.push_back(cell_from(cell));
  }
  return path;
}

}  // namespace adit
