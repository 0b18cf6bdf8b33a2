// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// A frontier in the sense of Yamauchi (1997): drivable cells next to unseen ones.
struct DetectedFrontier {
  Eigen::Vector2d p_map{0.0, 0.0};          ///< a drivable point at it [m]
  Eigen::Vector2d direction_map{1.0, 0.0};  ///< into the unseen space, a unit vector
  double width_m = 0.0;  ///< approximate width from wall to wall, across that direction
  Access access = Access::kReachable;
  bool at_dismissed_wall = false;  ///< returns of the level lasers near it count as no wall
};

/// All frontiers, ordered by their lowest cell. Frontier cells no farther apart than
/// `cluster_distance_m` form one.
std::vector<DetectedFrontier> detect_frontiers(const DrivableSpace& space,
                                               double cluster_distance_m);

}  // namespace adit
