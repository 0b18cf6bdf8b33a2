// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tools/sample_mine/synthetic_odometry.hpp"
#include "tools/sample_mine/synthetic_world.hpp"

namespace adit {

/// A mine to be led astray in, after figure 4 of the paper: two parallel drifts, "south" along y =
/// 0 and "north" along y = 12 m, from x = 0 to 70 m, whose walls are the same to the centimetre.
/// They are joined at their east end, where the south drift turns north and goes on as a short dead
/// end, so that a corner is what tells them apart. A loop of 600 m leads from the west end
/// of the north drift round all of it to the west end of the south drift.
SyntheticWorld parallel_mine(std::uint64_t seed);

/// A way of about 920 m: from the west end of the south drift to the east, back through the north
/// drift, around the long loop, and once more through the south drift, its corner and half of the
/// north drift. Nothing is seen twice before the robot is in the south drift again.
std::vector<Eigen::Vector2d> parallel_mine_route();

/// Odometry whose only error worth the name is a slow turn of the heading. When the robot comes
/// back, it believes itself some 10 m farther north than it is: in the north drift.
/// Scan matching is led there by a laser with SyntheticLaserModel::bearing_scale = 0.975.
OdometryModel parallel_mine_odometry();

}  // namespace adit
