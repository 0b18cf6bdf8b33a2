// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/world.hpp"
#include "tools/eval/trajectory_score.hpp"

namespace adit {

struct MapScoreOptions {
  double tolerance_m = 0.15;    ///< to a mapped point, for a wall that counts as mapped
  double deviation_m = 0.3;     ///< to a wall, beyond which a mapped point is wrong
  double range_m = 10.0;        ///< to which walls are said to be seen from the way
  double laser_height_m = 0.6;  ///< above the floor
};

/// How far mapped points are from the nearest wall of the world; more than 5 m count as 5. [m]
struct WallDistances {
  double mean_m = 0.0;
  double median_m = 0.0;
  double p95_m = 0.0;
};

/// How good a map is as a picture of a world: coverage and deviation as DARPA's map_analysis of the
/// Subterranean Challenge has them, in the plan.
struct MapScore {
  std::size_t mapped_points = 0;     ///< occupied cells
  std::size_t reference_points = 0;  ///< of walls seen from the way, 0.1 m apart
  double coverage = 0.0;             ///< share of the reference that has a mapped point near it
  /// The same for the outlines of the whole mine, seen or not; nothing where nobody knows them.
  std::optional<double> coverage_of_mine;
  double deviation = 0.0;  ///< share of the mapped points that are far from any wall of the world
  WallDistances wall_distance;
};

/// The walls that level rays without noise meet, half a degree apart all around, each half metre of
/// the way; one point for each cell of 0.1 m. p_world.
std::vector<Eigen::Vector2d> visible_walls(const Site& site, const Trajectory& truth,
                                           const MapScoreOptions& options);

/// `mapped` are occupied places in the frame of the map, `truth` is T_world_body. Throws
/// std::runtime_error where nothing is mapped, or where no wall is seen from the way.
MapScore score_map(const std::vector<Eigen::Vector2d>& mapped, const Pose2& T_world_map,
                   const Site& site, const Trajectory& truth, const MapScoreOptions& options = {});

/// A JSON object, over several lines.
std::string to_json(const TrajectoryScore& trajectory, const MapScore& map);

}  // namespace adit
