// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "sim/world/world.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/eval/trajectory_score.hpp"

namespace adit {

struct MapScoreOptions {
  double tolerance_m = 0.15;    ///< a reference point within this distance of a cell is covered
  double deviation_m = 0.3;     ///< a cell farther than this from any wall is wrong
  double range_m = 10.0;        ///< of the simulated laser that finds the visible walls
  double laser_height_m = 0.6;  ///< above the floor
};

/// Distances of the mapped points to the nearest wall of the world, at most 5 m each.
struct WallDistances {
  double mean_m = 0.0;
  double median_m = 0.0;
  double p95_m = 0.0;
};

/// Quality of a map against a world: coverage and deviation as defined by map_analysis of the DARPA
/// Subterranean Challenge, in 2D.
struct MapScore {
  std::size_t mapped_points = 0;     ///< occupied cells
  std::size_t reference_points = 0;  ///< of walls visible from the true path, 0.1 m apart
  double coverage = 0.0;             ///< share of the reference points that are covered
  /// Coverage of the outlines of the complete mine; nothing for a world without outlines.
  std::optional<double> coverage_of_mine;
  double deviation = 0.0;  ///< share of the mapped points that are wrong
  WallDistances wall_distance;
};

/// Walls visible from the true path: hits of horizontal rays without noise, 0.5° apart over 360°,
/// every 0.5 m of the path; one point per cell of 0.1 m. p_world.
std::vector<Eigen::Vector2d> visible_walls(const Site& site, const Trajectory& truth,
                                           const MapScoreOptions& options);

/// `mapped` are the occupied cells in map, `truth` is T_world_body. Throws std::runtime_error for
/// an empty map, or if no wall is visible from the path.
MapScore score_map(const std::vector<Eigen::Vector2d>& mapped, const Pose2& T_world_map,
                   const Site& site, const Trajectory& truth, const MapScoreOptions& options = {});

/// A JSON object of several lines.
std::string to_json(const TrajectoryScore& trajectory, const MapScore& map);

}  // namespace adit
