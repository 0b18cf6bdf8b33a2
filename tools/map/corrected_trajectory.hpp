// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Start of a local map, which anchors odom to map there by T_map_local · T_odom_local⁻¹.
struct MapAnchor {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_odom_local;
  Pose2 T_map_local;
};

/// The trajectory of one session in map: T_map_body for each T_odom_body. A pose between the starts
/// of two local maps gets a blend of their corrections. The weight is the share of the distance
/// travelled, rotation included (1 m per radian), so that the path is continuous and does not move
/// while the body rests. Poses before the first anchor get its correction, poses after the last one
/// that of the last; without anchors map is odom. `anchors` must be in order of time.
Trajectory corrected_trajectory(const Trajectory& odometry, const std::vector<MapAnchor>& anchors);

}  // namespace adit
