// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "common/config/config_file.hpp"
#include "common/types/cloud.hpp"
#include "procs/planning/planning.hpp"
#include "procs/terrain/terrain_params.hpp"

namespace adit {

/// Goal relative to the pose of the scan, in level.
struct GoalChoice {
  PlanGoal::Kind kind = PlanGoal::Kind::kAlong;
  Pose2 T_level_goal;        ///< for kAlong, only the heading is used
  double distance_m = 10.0;  ///< maximum distance, for kAlong
};

struct ScanPlanParams {
  TerrainParams terrain;
  PlanningParams planning;
};

/// Loads the sections terrain and planning and their shared sections. A non-empty `estimator`
/// overrides that of the terrain. Throws ConfigError.
ScanPlanParams load_scan_plan_params(const ConfigFile& config, const std::string& estimator);

/// Terrain and path of one scan.
struct ScanPlan {
  /// Wall times of the steps [ms].
  struct Times {
    double terrain_ms = 0.0;
    double kernels_ms = 0.0;  ///< once per vehicle, not per scan
    double c_space_ms = 0.0;
    double search_ms = 0.0;

    [[nodiscard]] double scan_to_path_ms() const { return terrain_ms + c_space_ms + search_ms; }
  };

  TerrainMap terrain;
  PlanGoal goal;
  PlannedPath path;
  std::array<std::size_t, 5> ground{};  ///< number of cells, in the order of Ground
  Times times;
};

/// Computes terrain, C-space and path of one scan, starting at the pose of the scan. `planning`
/// must be constructed from the params; it retains the C-space of the plan.
ScanPlan plan_on_scan(const Cloud& cloud, const GoalChoice& goal, const ScanPlanParams& params,
                      Planning& planning);

/// Computes C-space and path for a goal on a terrain map, from a pose in odom. As above.
ScanPlan plan_on_terrain(TerrainMap terrain, const PlanGoal& goal, const Pose2& T_odom_body,
                         Planning& planning);

}  // namespace adit
