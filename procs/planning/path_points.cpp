// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/path_points.hpp"

#include <algorithm>
#include <cmath>

#include "procs/planning/footprint.hpp"
#include "procs/planning/lattice.hpp"

namespace adit {
namespace {

/// Least distance in a layer along the edges of a rectangle, a cell apart.
double least_along(const BodyRectangle& rectangle, const Pose2& T_level_body,
                   const std::vector<float>& distances, const TerrainMap& terrain, double most_m) {
  double least = most_m;
  const auto look = [&](double x, double y) {
    const Eigen::Vector2d p = T_level_body * Eigen::Vector2d(x, y);
    const Eigen::Vector2d cells = (p - terrain.p_level_corner) / terrain.cell_m;
    const auto column = static_cast<int>(std::floor(cells.x()));
    const auto row = static_cast<int>(std::floor(cells.y()));
    if (!terrain.contains(column, row)) return;
    const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(terrain.columns) +
                   static_cast<std::size_t>(column);
    least = std::min(least, static_cast<double>(distances[i]));
  };
  const Eigen::Vector2d low = rectangle.middle - rectangle.half;
  const Eigen::Vector2d high = rectangle.middle + rectangle.half;
  const int along = static_cast<int>(std::ceil(2.0 * rectangle.half.x() / terrain.cell_m));
  const int across = static_cast<int>(std::ceil(2.0 * rectangle.half.y() / terrain.cell_m));
  for (int i = 0; i <= along; ++i) {
    const double x = std::lerp(low.x(), high.x(), static_cast<double>(i) / along);
    look(x, low.y());
    look(x, high.y());
  }
  for (int i = 0; i <= across; ++i) {
    const double y = std::lerp(low.y(), high.y(), static_cast<double>(i) / across);
    look(low.x(), y);
    look(high.x(), y);
  }
  return least;
}

}  // namespace

double clearance(const Pose2& T_level_body, const Vehicle& vehicle, const GroundLayers& layers,
                 const TerrainMap& terrain, double most_m) {
  double least =
      least_along(body_outline(vehicle), T_level_body, layers.body_distance_m, terrain, most_m);
  for (const BodyRectangle& track : wheel_tracks(vehicle)) {
    least = least_along(track, T_level_body, layers.wheel_distance_m, terrain, least);
  }
  return least;
}

std::vector<PathPoint> path_points(const LatticePath& path, const LatticePose& start,
                                   const MotionPrimitives& primitives, const HeadingSet& headings,
                                   const TerrainMap& terrain, const GroundLayers& layers,
                                   const Vehicle& vehicle, double spacing_m) {
  std::vector<PathPoint> points;
  const auto add = [&](const Pose2& T_level_body, double curvature, bool reverse, double cost) {
    points.push_back({terrain.T_odom_level * T_level_body, curvature, reverse,
                      clearance(T_level_body, vehicle, layers, terrain), cost / kCostPerM});
  };
  LatticePose pose = start;
  double cost = 0.0;
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const MotionPrimitive& step = *path.steps[i];
    const Eigen::Vector2d from = terrain.centre(pose.column, pose.row);
    const double length = step.manoeuvre.length_m();
    const int pieces = std::max(1, static_cast<int>(std::lround(length / spacing_m)));
    const bool changes = i > 0 && path.steps[i - 1]->reverse != step.reverse;
    if (changes) add({from.x(), from.y(), headings.angle(pose.heading)}, 0.0, !step.reverse, cost);
    for (int piece = 0; piece < pieces; ++piece) {
      const double way = length * piece / pieces;
      const Pose2 T_step_body = primitives.pose_at(step, way);
      add({from.x() + T_step_body.x, from.y() + T_step_body.y, T_step_body.theta},
          primitives.curvature_at(step, way), step.reverse,
          std::lerp(cost, path.costs[i], way / length));
    }
    cost = path.costs[i];
    pose = Lattice::behind(pose, step);
  }
  const Eigen::Vector2d end = terrain.centre(pose.column, pose.row);
  add({end.x(), end.y(), headings.angle(pose.heading)}, 0.0,
      !path.steps.empty() && path.steps.back()->reverse, cost);
  return points;
}

}  // namespace adit
