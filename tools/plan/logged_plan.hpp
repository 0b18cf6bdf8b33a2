// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "procs/planning/planning.hpp"

namespace adit {

/// What planning received for a goal of a mission, and its answer.
struct LoggedPlan {
  TerrainMap terrain;
  PlanGoal goal;
  Pose2 T_odom_body;
  std::optional<PlanningParams> params;  ///< in effect; empty if the log does not have them
  std::optional<PlannedPath> path;       ///< empty if the log ends before
  std::vector<std::string> warnings;     ///< about parameters that this version does not know
};

/// Reads the newest terrain map (channel TERRAIN) and pose (POSE) before the goal with this id
/// (GOAL), the parameters of the stage planning (CONFIG) and the answer (PATH). Throws
/// std::runtime_error if the log has no such goal, no terrain or pose before it, or if the goal was
/// to retrace the traversed path, which needs no terrain.
LoggedPlan logged_plan(const std::filesystem::path& file, int goal);

}  // namespace adit
