// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/scan_plan.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "common/config/config.hpp"
#include "procs/terrain/terrain.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;

/// Wall time of the work.
template <class Work>
double milliseconds(const Work& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

PlanGoal in_odom(const GoalChoice& choice, const Cloud& cloud) {
  PlanGoal goal;
  goal.utime = cloud.utime;
  goal.id = cloud.id;
  goal.kind = choice.kind;
  goal.T_odom_goal = cloud.T_odom_level * choice.T_level_goal;
  goal.distance_m = choice.distance_m;
  return goal;
}

}  // namespace

ScanPlanParams load_scan_plan_params(const ConfigFile& config, const std::string& estimator) {
  ScanPlanParams params{load_section<TerrainParams>(config, "terrain"),
                        load_section<PlanningParams>(config, "planning")};
  if (!estimator.empty()) params.terrain.estimator.kind = estimator;
  return params;
}

ScanPlan plan_on_scan(const Cloud& cloud, const GoalChoice& choice, const ScanPlanParams& params,
                      Planning& planning) {
  TerrainMap terrain;
  const double terrain_ms = milliseconds([&] { terrain = Terrain(params.terrain).make(cloud); });
  ScanPlan plan =
      plan_on_terrain(std::move(terrain), in_odom(choice, cloud), cloud.T_odom_level, planning);
  plan.times.terrain_ms = terrain_ms;
  return plan;
}

ScanPlan plan_on_terrain(TerrainMap terrain, const PlanGoal& goal, const Pose2& T_odom_body,
                         Planning& planning) {
  ScanPlan plan;
  plan.terrain = std::move(terrain);
  plan.goal = goal;
  for (const TerrainCell& cell : plan.terrain.cells) {
    ++plan.ground[static_cast<std::size_t>(cell.ground)];
  }
  const auto prepare = [&] { planning.prepare(plan.terrain, T_odom_body); };
  const double first_ms = milliseconds(prepare);
  plan.times.c_space_ms = milliseconds(prepare);
  plan.times.kernels_ms = std::max(first_ms - plan.times.c_space_ms, 0.0);
  plan.times.search_ms =
      milliseconds([&] { plan.path = planning.find(plan.terrain, plan.goal, T_odom_body); });
  return plan;
}

}  // namespace adit
