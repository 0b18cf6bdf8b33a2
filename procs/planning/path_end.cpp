// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/path_end.hpp"

#include "procs/planning/start_pose.hpp"

namespace adit {
namespace {

constexpr double kRoomM = 1.5;  // about the least radius of a turn
constexpr double kStepM = 0.3;

bool has_room(const Pose2& T_level_body, bool reverse, const TerrainMap& terrain,
              const HeadingSet& headings, const Lattice& seen) {
  for (double ahead_m = kStepM; ahead_m <= kRoomM; ahead_m += kStepM) {
    const Pose2 T_level_ahead = T_level_body * Pose2{reverse ? -ahead_m : ahead_m, 0.0, 0.0};
    const LatticePose pose = nearest_pose(terrain, headings, T_level_ahead);
    if (!seen.space.contains(pose.column, pose.row)) return true;  // nobody knows
    if (!seen.stands(pose)) return false;
  }
  return true;
}

}  // namespace

void end_with_room(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                   const Lattice& seen, const GoalField& goals) {
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  for (std::size_t n = path.points.size(); n > 1; --n) {
    const Pose2 T_level_end = T_level_odom * path.points[n - 1].T_odom_body;
    const double reached_m = goals.progress(T_level_end.translation());
    if (reached_m < goals.least_progress()) return;
    // Where the direction changes, the place is there twice.
    if (path.points[n - 1].cost == path.points[n - 2].cost) continue;
    if (!has_room(T_level_end, path.points[n - 2].reverse, terrain, headings, seen)) continue;
    path.points.resize(n);
    path.points.back().curvature_1_m = 0.0;
    path.points.back().reverse = path.points[n - 2].reverse;
    path.reached_m = reached_m;
    return;
  }
}

}  // namespace adit
