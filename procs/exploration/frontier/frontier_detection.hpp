// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// Where the space that a vehicle can be in meets what was never seen.
struct DetectedFrontier {
  Eigen::Vector2d p_map{0.0, 0.0};          ///< a drivable place at it [m]
  Eigen::Vector2d direction_map{1.0, 0.0};  ///< into what was not seen, a unit vector
  double width_m = 0.0;                     ///< from wall to wall, about
  Access access = Access::kReachable;
};

/// All of them, by their lowest cell; `cluster_distance_m`: frontier cells that are no farther
/// apart are one.
std::vector<DetectedFrontier> detect_frontiers(const DrivableSpace& space,
                                               double cluster_distance_m);

}  // namespace adit
