// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/sensing/laser_mount.hpp"
#include "sim/laser/spinning_lidar_params.hpp"

namespace adit {

/// What the rings of a standing spinning lidar show of level ground in one direction, as distances
/// from the lidar along the ground.
struct LidarGround {
  double from_m = 0.0;  ///< to the nearest ring
  double to_m = 0.0;    ///< to the last ring before the first gap that is too wide
};

/// `bearing_rad`: direction in the body frame. `gap_max_m`: between two rings that show the ground
/// between them. Nothing if no ring meets the ground.
std::optional<LidarGround> lidar_ground(const Lasers& lasers, const SpinningLidarParams& lidar,
                                        double bearing_rad, double gap_max_m);

}  // namespace adit
