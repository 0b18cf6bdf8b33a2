// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// The begin of a local map: what ties odom to map there, by T_map_local · T_odom_local⁻¹.
struct MapAnchor {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_odom_local;
  Pose2 T_map_local;
};

/// The way of one session in map: T_map_body for each T_odom_body. Each pose hangs on the local map
/// in which it was measured; from the begin of one local map to the next its correction passes into
/// that of the next, by way and turning (a metre for a radian), so that the path does not jump and
/// does not move while the body rests. Before the first anchor its correction holds, after the last
/// one that of the last; without anchors odom is map. `anchors` are in order of time.
Trajectory corrected_trajectory(const Trajectory& odometry, const std::vector<MapAnchor>& anchors);

}  // namespace adit
