// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "procs/mapping/mapping.hpp"
#include "sim/world/world_truth.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit::test {

/// A robot without dynamics: it is put along a path, and its odometry errs as that of scan matching
/// does. Thousands of times faster than a mission.
struct WalkOptions {
  std::uint64_t seed = 1;  ///< of the noise of the lasers and of the errors of the odometry
  Lasers lasers = {};      ///< mounts of both
  double step_m = 0.2;
  double turn_rad = 0.2;  ///< on the spot, at corners, per step
};

/// Lasers at both ends, at this distance from the middle of the body.
Lasers lasers_at_ends(double from_middle_m);

/// The map of a walk, with the truth.
struct WalkedMap {
  std::unique_ptr<Mapping> map;         ///< finished
  std::map<std::int64_t, Pose2> truth;  ///< T_world_body by the time of each scan
  Lasers lasers;
};

/// Walks along a polyline in world, and maps.
WalkedMap walked_map(const WallWorld& world, const std::vector<Eigen::Vector2d>& path,
                     const WalkOptions& options);

/// A path along the centre lines from a node: each tunnel that is reached within `length_m` there
/// and back, branches in the order of the edges from `first_edge` on.
std::vector<Eigen::Vector2d> tour(const TunnelGraph& tunnels, int from_node, double length_m,
                                  std::size_t first_edge = 0);

}  // namespace adit::test
