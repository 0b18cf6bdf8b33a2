// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/types/cloud.hpp"
#include "procs/planning/planning.hpp"

namespace adit {

/// What planning received for a goal of a mission, and its answer.
struct LoggedPlan {
  TerrainMap terrain;
  PlanGoal goal;
  Pose2 T_odom_body;
  Cloud cloud;  ///< the newest scan of the terrain map; empty if the log does not have it
  std::optional<PlanningParams> params;  ///< in effect; empty if the log does not have them
  std::optional<PlannedPath> path;       ///< empty if the log ends before
  std::vector<std::string> warnings;     ///< skipped bytes, parameters of another version
};

/// Reads the newest terrain map (channel TERRAIN), its scan (CLOUD) and the newest pose (POSE)
/// before the goal with this id (GOAL), the parameters of the stage planning (CONFIG) and the
/// answer (PATH), once through the log up to there. Throws std::runtime_error if the log has no
/// such goal, no terrain or pose before it, or if the goal was to retrace the traversed path, which
/// needs no terrain.
LoggedPlan logged_plan(const std::filesystem::path& file, int goal);

}  // namespace adit
