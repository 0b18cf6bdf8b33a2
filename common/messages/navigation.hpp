// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/drive_command_t.hpp"
#include "adit/driving_state_t.hpp"
#include "adit/plan_goal_t.hpp"
#include "adit/planned_path_t.hpp"
#include "adit/stop_t.hpp"
#include "adit/vehicle_state_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

plan_goal_t to_message(const PlanGoal& goal);

/// Rejects an implausible time, a negative id, an unknown kind, a pose that is not finite, a
/// distance that is not finite or not positive, and a route or traversed path that is not finite or
/// lacks the points that its kind requires.
Result<PlanGoal> from_message(const plan_goal_t& message);

/// Contains all points of the path, and the first blocking cells that fit kFragmentBytes with the
/// count of all; the terrain map shows the rest.
planned_path_t to_message(const PlannedPath& path);

/// Rejects an implausible time, a negative id, an unknown outcome or reason, points without a path
/// or a path without points, numbers that are not finite except an infinite clearance and heights,
/// and a cell count below the number of blocking cells.
Result<PlannedPath> from_message(const planned_path_t& message);

driving_state_t to_message(const DrivingState& state);

/// Rejects an implausible time, a negative id, an unknown state, a distance that is negative or not
/// finite, an error that is not finite.
Result<DrivingState> from_message(const driving_state_t& message);

drive_command_t to_message(const DriveCommand& command);

/// Rejects an implausible time, a speed or curvature that is not finite.
Result<DriveCommand> from_message(const drive_command_t& message);

stop_t to_message(const StopOrder& order);

/// Rejects an implausible time.
Result<StopOrder> from_message(const stop_t& message);

vehicle_state_t to_message(const VehicleState& state);

/// Rejects an implausible time, a speed or curvature that is not finite, a share outside 0 to 1.
Result<VehicleState> from_message(const vehicle_state_t& message);

}  // namespace adit
