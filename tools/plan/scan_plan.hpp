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

/// Where to go from the scan, in level.
struct GoalChoice {
  PlanGoal::Kind kind = PlanGoal::Kind::kAlong;
  Pose2 T_level_goal;        ///< of kAlong the heading counts alone
  double distance_m = 10.0;  ///< of kAlong
};

struct ScanPlanParams {
  TerrainParams terrain;
  PlanningParams planning;
};

/// The sections terrain and planning, and what they share. `estimator` takes the place of that of
/// the terrain unless it is empty. Throws ConfigError.
ScanPlanParams load_scan_plan_params(const ConfigFile& config, const std::string& estimator);

/// What came of one scan.
struct ScanPlan {
  /// How long the steps took [ms], by the clock.
  struct Times {
    double terrain_ms = 0.0;
    double kernels_ms = 0.0;  ///< once for a vehicle, not for each scan
    double c_space_ms = 0.0;
    double search_ms = 0.0;

    [[nodiscard]] double scan_to_path_ms() const { return terrain_ms + c_space_ms + search_ms; }
  };

  TerrainMap terrain;
  PlanGoal goal;
  PlannedPath path;
  std::array<std::size_t, 5> ground{};  ///< cells, in the order of Ground
  Times times;
};

/// Terrain, C-space and path of one scan, for a robot that stands where the scan was made.
/// `planning` is for the vehicle of the params; what the plan rests on stays with it.
ScanPlan plan_on_scan(const Cloud& cloud, const GoalChoice& goal, const ScanPlanParams& params,
                      Planning& planning);

double path_length_m(const PlannedPath& path);
/// From the footprint to the nearest lethal cell anywhere on the path; infinite without a path.
double least_clearance_m(const PlannedPath& path);
const char* name_of(PlanOutcome outcome);

}  // namespace adit
