// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/types/vehicle.hpp"
#include "sim/vehicle/stance.hpp"
#include "sim/world/world.hpp"
#include "tests/support/worlds/random_corridor.hpp"

namespace adit {

/// What ends a drive, and where.
struct FeasibilityFault {
  Pose2 T_world_body;
  double driven_m = 0.0;  ///< from the beginning
  std::string what;
};

/// Why the vehicle, as its wheels hold it, may not be where it is: something within its body, or
/// water that is too deep at the body's origin or a wheel.
std::optional<std::string> find_fault_at(const Site& site, const Vehicle& vehicle,
                                         const Eigen::Isometry3d& T_world_body);

/// Moves the true vehicle along poses in world, of each straight to the next, by centimetres, and
/// says what it meets first: no ground, a step, a tilt, a touch, deep water. `floor_m` is the
/// height of the ground where it begins.
std::optional<FeasibilityFault> find_first_fault(const Site& site, const Vehicle& vehicle,
                                                 double floor_m, const std::vector<Pose2>& poses);

/// The vehicle with room all round it, and with less in it to spare: what it can do, nobody doubts.
Vehicle inflated_vehicle(const Vehicle& vehicle, double room_m);

/// How far along its drift the vehicle can be driven forwards in the true mine [m], up to
/// `enough_m`: a search over poses that has nothing in common with the planner, each tried in the
/// mesh. Bends no tighter than 2 m.
double feasible_distance_m(const Corridor& corridor, const Vehicle& vehicle, double enough_m);

}  // namespace adit
