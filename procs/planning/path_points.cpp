// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/path_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {
namespace {

constexpr double kClearanceMaxM = 5.0;
// A drive of 10 m by odometry alone ends within 0.3 m of its goal; plus a cell of the terrain.
constexpr double kEndClearanceMinM = 0.4;
constexpr double kStepM = 0.1;
constexpr double kWidthReserveM = 0.4;  // for margins and the cell size

using BodyPoints = std::vector<Eigen::Vector2d>;

/// Along the edges of the wheel tracks, at each cell.
BodyPoints wheel_edges(const Vehicle& vehicle, double cell_m) {
  BodyPoints edges;
  for (const ConvexPolygon& track : wheel_tracks(vehicle)) {
    const BodyPoints points = track.boundary(cell_m);
    edges.insert(edges.end(), points.begin(), points.end());
  }
  return edges;
}

/// Minimum distance of points of the body to marked ground; at most `max_m`.
double least_distance_m(const BodyPoints& p_body, const Pose2& T_level_body,
                        const Grid2<float>& distances, const TerrainMap& terrain, double max_m) {
  double distance_m = max_m;
  for (const Eigen::Vector2d& p : p_body) {
    const Eigen::Vector2i cell = terrain.cell_at(T_level_body * p);
    if (!distances.contains(cell)) continue;
    distance_m = std::min(distance_m, static_cast<double>(distances.at(cell)));
  }
  return distance_m;
}

/// Width of a tunnel in which the vehicle can turn by π/2 into another one of the same width: its
/// outer side follows the outer walls, and its inner side passes the corner.
double turning_tunnel_width_m(const Vehicle& vehicle) {
  const Eigen::Vector2d half = body_outline(vehicle).high();
  const double outer_m = std::hypot(vehicle.turning_radius_m + half.y(), half.x());
  const double inner_m = std::max(0.0, vehicle.turning_radius_m - half.y());
  return outer_m - inner_m / std::numbers::sqrt2 + kWidthReserveM;
}

/// Distance that the body can continue straight ahead up to lethal ground, at most `max_m`.
double clear_ahead_m(const Pose2& T_level_body, bool reverse, const TerrainMap& terrain,
                     const HeadingSet& headings, const Lattice& lattice, double max_m) {
  double clear_m = 0.0;
  while (clear_m < max_m) {
    const double ahead_m = clear_m + kStepM;
    const Pose2 T_level_ahead = T_level_body * Pose2{reverse ? -ahead_m : ahead_m, 0.0, 0.0};
    const LatticePose pose = nearest_pose(terrain, headings, T_level_ahead);
    if (!lattice.space.contains(pose.column, pose.row)) return max_m;  // beyond the map
    if (!lattice.is_valid(pose)) break;
    clear_m = ahead_m;
  }
  return clear_m;
}

void truncate(PlannedPath& path, std::size_t points, double reached_m) {
  path.points.resize(points);
  path.points.back().curvature_1_m = 0.0;
  path.points.back().reverse = path.points[points - 2].reverse;
  path.reached_m = reached_m;
}

}  // namespace

std::vector<PathPoint> path_points(const LatticePath& path, const LatticePose& start,
                                   const MotionPrimitives& primitives, const HeadingSet& headings,
                                   const TerrainMap& terrain, const GroundLayers& layers,
                                   const Vehicle& vehicle, double spacing_m) {
  std::vector<PathPoint> points;
  const BodyPoints body = body_outline(vehicle).boundary(terrain.cell_m);
  const BodyPoints wheels = wheel_edges(vehicle, terrain.cell_m);
  const auto add = [&](const Pose2& T_level_body, double curvature, bool reverse, double cost) {
    const double body_m =
        least_distance_m(body, T_level_body, layers.body_distance_m, terrain, kClearanceMaxM);
    const double clearance_m =
        least_distance_m(wheels, T_level_body, layers.wheel_distance_m, terrain, body_m);
    points.push_back(
        {terrain.T_odom_level * T_level_body, curvature, reverse, clearance_m, cost / kCostPerM});
  };
  LatticePose pose = start;
  double cost = 0.0;
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const MotionPrimitive& step = *path.steps[i];
    const Eigen::Vector2d from = terrain.centre(pose.column, pose.row);
    const double length = step.curve.length_m();
    const int segments = std::max(1, static_cast<int>(std::lround(length / spacing_m)));
    const bool changes = i > 0 && path.steps[i - 1]->reverse != step.reverse;
    if (changes) add({from.x(), from.y(), headings.angle(pose.heading)}, 0.0, !step.reverse, cost);
    for (int segment = 0; segment < segments; ++segment) {
      const double s_m = length * segment / segments;
      const Pose2 T_step_body = primitives.pose_at(step, s_m);
      add({from.x() + T_step_body.x, from.y() + T_step_body.y, T_step_body.theta},
          primitives.curvature_at(step, s_m), step.reverse,
          std::lerp(cost, path.costs[i], s_m / length));
    }
    cost = path.costs[i];
    pose = Lattice::successor(pose, step);
  }
  const Eigen::Vector2d end = terrain.centre(pose.column, pose.row);
  add({end.x(), end.y(), headings.angle(pose.heading)}, 0.0,
      !path.steps.empty() && path.steps.back()->reverse, cost);
  return points;
}

void refine_clearance(PlannedPath& path, double enough_m, const TerrainMap& terrain,
                      const GroundLayers& layers, const WallDistance& walls,
                      const Vehicle& vehicle) {
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  const BodyPoints wheels = wheel_edges(vehicle, terrain.cell_m);
  for (PathPoint& point : path.points) {
    if (point.clearance_m > enough_m) continue;
    const Pose2 T_level_body = T_level_odom * point.T_odom_body;
    const double walls_m = walls.clearance_m(T_level_body);
    const double refined_m =
        least_distance_m(wheels, T_level_body, layers.wheel_distance_m, terrain, walls_m);
    point.clearance_m = std::max(point.clearance_m, refined_m);
  }
}

void trim_to_clear_end(PlannedPath& path, const TerrainMap& terrain, const HeadingSet& headings,
                       const Lattice& lattice, const GoalField& goals, const Vehicle& vehicle) {
  const double room_m = turning_tunnel_width_m(vehicle);
  const Pose2 T_level_odom = terrain.T_odom_level.inverse();
  std::size_t clear_end = 0;  // number of points of the longest path with a clear end
  double clear_end_reached_m = 0.0;
  for (std::size_t n = path.points.size(); n > 1; --n) {
    const Pose2 T_level_end = T_level_odom * path.points[n - 1].T_odom_body;
    const double reached_m = goals.progress(T_level_end.translation());
    if (reached_m < goals.min_progress() - kEndClearanceMinM) break;
    // The second point of a change of direction.
    if (path.points[n - 1].cost == path.points[n - 2].cost) continue;
    const double clear_m =
        clear_ahead_m(T_level_end, path.points[n - 2].reverse, terrain, headings, lattice, room_m) +
        1e-9;
    if (clear_end == 0 && clear_m >= kEndClearanceMinM) {
      clear_end = n;
      clear_end_reached_m = reached_m;
    }
    if (clear_m < room_m || reached_m < goals.min_progress()) continue;
    truncate(path, n, reached_m);
    return;
  }
  if (clear_end > 0) truncate(path, clear_end, clear_end_reached_m);
}

}  // namespace adit
