// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/path_end.hpp"

#include <cstddef>

#include "procs/planning/start_pose.hpp"

namespace adit {
namespace {

constexpr double kRoomM = 1.5;  // about the least radius of a turn
// By wheels alone a drive of 10 m is known to 0.3 m; and a cell of the terrain.
constexpr double kLeastRoomM = 0.4;
constexpr double kStepM = 0.1;

/// Straight on until something lethal; kRoomM at most.
double clear_ahead_m(const Pose2& T_level_body, bool reverse, const TerrainMap& terrain,
                     const HeadingSet& headings, const Lattice& seen) {
  double clear_m = 0.0;
  while (clear_m < kRoomM) {
    const double ahead_m = clear_m + kStepM;
    const Pose2 T_level_ahead = T_level_body * Pose2{reverse ? -ahead_m : ahead_m, 0.0, 0.0};
    const LatticePose pose = nearest_pose(terrain, headings, T_level_ahead);
    if (!seen.space.contains(pose.column, pose.row)) return kRoomM;  // nobody knows
    if (!seen.stands(pose)) break;
    clear_m = ahead_m;
  }
  return clear_m;
}

void cut(PlannedPath& path, std::size_t points, double reached_m) {
  path.points.resize(points);
  path.points.back().curvature_1_m = 0.0;
  path.points.back().reverse = path.points[points - 2].reverse;
  path.reached_m = reached_m;
}

}  // namespace

void end_with_room(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                   const Lattice& seen, const GoalField& goals) {
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  const auto reached_at = [&](std::size_t points) {
    const Pose2 T_level_end = T_level_odom * path.points[points - 1].T_odom_body;
    return goals.progress(T_level_end.translation());
  };
  std::size_t least_room = 0;
  for (std::size_t n = path.points.size(); n > 1; --n) {
    const double reached_m = reached_at(n);
    if (reached_m < goals.least_progress() - kLeastRoomM) break;
    // Where the direction changes, the place is there twice.
    if (path.points[n - 1].cost == path.points[n - 2].cost) continue;
    const Pose2 T_level_end = T_level_odom * path.points[n - 1].T_odom_body;
    const double clear_m =
        clear_ahead_m(T_level_end, path.points[n - 2].reverse, terrain, headings, seen) + 1e-9;
    if (least_room == 0 && clear_m >= kLeastRoomM) least_room = n;
    if (clear_m < kRoomM || reached_m < goals.least_progress()) continue;
    cut(path, n, reached_m);
    return;
  }
  if (least_room > 0) cut(path, least_room, reached_at(least_room));
}

}  // namespace adit
