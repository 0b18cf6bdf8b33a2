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

/// The first fault on a path.
struct FeasibilityFault {
  Pose2 T_world_body;
  double driven_m = 0.0;  ///< distance from the start of the path
  std::string what;       ///< kind of fault
};

/// The fault of a vehicle that stands at a 3D pose: an object within its body, or water that is too
/// deep below it (checked on a 3×3 grid over wheelbase and track). Nothing if the pose is feasible.
std::optional<std::string> find_fault_at(const Site& site, const Vehicle& vehicle,
                                         const Eigen::Isometry3d& T_world_body);

/// Moves the true vehicle along poses in world, interpolated at steps of 1 cm, and returns the
/// first fault: no ground, step, tilt, collision or deep water. `floor_m` is the floor height at
/// the first pose.
std::optional<FeasibilityFault> find_first_fault(const Site& site, const Vehicle& vehicle,
                                                 double floor_m, const std::vector<Pose2>& poses);

/// The vehicle inflated by `room_m` on all sides and with margins on its limits: wherever it can
/// drive, the real vehicle certainly can.
Vehicle inflated_vehicle(const Vehicle& vehicle, double room_m);

/// Distance that the vehicle can be driven forwards along the tunnel in the true mine [m], up to
/// `enough_m`. A search over poses that is independent of the planner and checks each pose against
/// the mesh. The smallest turning radius is 2 m.
double feasible_distance_m(const Corridor& corridor, const Vehicle& vehicle, double enough_m);

}  // namespace adit
