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

/// Refused: an implausible time, a negative id, an unknown kind, a pose that is not finite, a
/// distance that is not finite or not positive, a route or a track that the kind needs and that is
/// none, or is not finite.
Result<PlanGoal> from_message(const plan_goal_t& message);

/// Of the blocking cells the first that fit kFragmentBytes, and the count of all: a person sees the
/// rest in the terrain. The points of a path are never cut.
planned_path_t to_message(const PlannedPath& path);

/// Refused: an implausible time, a negative id, an unknown outcome or reason, points without a path
/// or a path without points, what is not finite but for a clearance that is infinite and heights,
/// fewer blocking cells in all than are there.
Result<PlannedPath> from_message(const planned_path_t& message);

driving_state_t to_message(const DrivingState& state);

/// Refused: an implausible time, a negative id, an unknown state, a way that is negative or not
/// finite, an error that is not finite.
Result<DrivingState> from_message(const driving_state_t& message);

drive_command_t to_message(const DriveCommand& command);

/// Refused: an implausible time, a speed or curvature that is not finite.
Result<DriveCommand> from_message(const drive_command_t& message);

stop_t to_message(const StopOrder& order);

/// Refused: an implausible time.
Result<StopOrder> from_message(const stop_t& message);

vehicle_state_t to_message(const VehicleState& state);

/// Refused: an implausible time, a speed or curvature that is not finite, a share beyond 0 to 1.
Result<VehicleState> from_message(const vehicle_state_t& message);

}  // namespace adit
