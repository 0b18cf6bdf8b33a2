// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/path_end.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "procs/planning/footprint.hpp"
#include "procs/planning/start_pose.hpp"

namespace adit {
namespace {

// By wheels alone a drive of 10 m is known to 0.3 m; and a cell of the terrain.
constexpr double kLeastRoomM = 0.4;
constexpr double kStepM = 0.1;
constexpr double kSpareM = 0.4;  // of what margins and cells take off

/// Of a drift in which the vehicle turns by a right angle into another that is as wide: its outer
/// side keeps to the outer walls, and its inner side just passes the corner.
double width_to_turn_in(const Vehicle& vehicle) {
  const Eigen::Vector2d half = body_outline(vehicle).half;
  const double outer_m = std::hypot(vehicle.turning_radius_m + half.y(), half.x());
  const double inner_m = std::max(0.0, vehicle.turning_radius_m - half.y());
  return outer_m - inner_m / std::numbers::sqrt2 + kSpareM;
}

/// Straight on until something lethal; `enough_m` at most.
double clear_ahead_m(const Pose2& T_level_body, bool reverse, const TerrainMap& terrain,
                     const HeadingSet& headings, const Lattice& seen, double enough_m) {
  double clear_m = 0.0;
  while (clear_m < enough_m) {
    const double ahead_m = clear_m + kStepM;
    const Pose2 T_level_ahead = T_level_body * Pose2{reverse ? -ahead_m : ahead_m, 0.0, 0.0};
    const LatticePose pose = nearest_pose(terrain, headings, T_level_ahead);
    if (!seen.space.contains(pose.column, pose.row)) return enough_m;  // nobody knows
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
                   const Lattice& seen, const GoalField& goals, const Vehicle& vehicle) {
  const double room_m = width_to_turn_in(vehicle);
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  std::size_t least_room = 0;
  double least_room_reached_m = 0.0;
  for (std::size_t n = path.points.size(); n > 1; --n) {
    const Pose2 T_level_end = T_level_odom * path.points[n - 1].T_odom_body;
    const double reached_m = goals.progress(T_level_end.translation());
    if (reached_m < goals.least_progress() - kLeastRoomM) break;
    // Where the direction changes, the place is there twice.
    if (path.points[n - 1].cost == path.points[n - 2].cost) continue;
    const double clear_m =
        clear_ahead_m(T_level_end, path.points[n - 2].reverse, terrain, headings, seen, room_m) +
        1e-9;
    if (least_room == 0 && clear_m >= kLeastRoomM) {
      least_room = n;
      least_room_reached_m = reached_m;
    }
    if (clear_m < room_m || reached_m < goals.least_progress()) continue;
    cut(path, n, reached_m);
    return;
  }
  if (least_room > 0) cut(path, least_room, least_room_reached_m);
}

}  // namespace adit
