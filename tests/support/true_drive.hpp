// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/vehicle/vehicle.hpp"
#include "sim/vehicle/stance.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// What ends a drive, and where.
struct DriveFault {
  Pose2 T_world_body;
  double way_m = 0.0;  ///< from the beginning
  std::string what;
};

/// Why the vehicle, as its wheels hold it, may not be where it is: something within its body, or
/// water that is too deep at the body's origin or a wheel.
std::optional<std::string> fault_around(const Site& site, const Vehicle& vehicle,
                                        const Eigen::Isometry3d& T_world_body);

/// Moves the true vehicle along poses in world, of each straight to the next, by centimetres, and
/// says what it meets first: no ground, a step, a tilt, a touch, deep water. `floor_m` is the
/// height of the ground where it begins.
std::optional<DriveFault> first_fault(const Site& site, const Vehicle& vehicle, double floor_m,
                                      const std::vector<Pose2>& poses);

}  // namespace adit
