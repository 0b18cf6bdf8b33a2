// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scores/corridor_run.hpp"

#include <ctime>

#include "procs/terrain/terrain.hpp"
#include "sim/sweep/tilt_sweep.hpp"

namespace adit {
namespace {

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

CorridorRun run_corridor(const Corridor& corridor, const std::string& estimator, std::uint64_t seed,
                         Planning& planning) {
  TiltSweep sweep;
  sweep.seed = seed;
  const Cloud cloud = tilt_sweep(*corridor.site, corridor.T_world_body, sweep);
  TerrainParams params;
  params.estimator.kind = estimator;
  const Terrain terrain(params);
  PlanGoal goal;
  goal.T_odom_goal.theta = corridor.direction_rad;

  CorridorRun run;
  const double begin_ms = thread_ms();
  run.terrain = terrain.make(cloud);
  const double made_ms = thread_ms();
  run.path = planning.plan(run.terrain, goal, cloud.T_odom_level);
  run.terrain_ms = made_ms - begin_ms;
  run.plan_ms = thread_ms() - made_ms;
  if (!run.found()) return run;

  std::vector<Pose2> poses{cloud.T_odom_level};
  for (const PathPoint& point : run.path.points) poses.push_back(point.T_odom_body);
  const double floor_m = corridor.T_world_body.translation().z();
  run.fault = find_first_fault(*corridor.site, Vehicle{}, floor_m, poses);
  run.along_m = corridor.tunnel.place_of(poses.back().translation()).s_m - kCorridorStart;
  return run;
}

}  // namespace adit
