// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"

namespace adit {

/// A path back over the traversed path, `goal.traversed_path_odom` (from the body backwards), where
/// no scan shows a path. It needs no terrain: the robot has driven there, and the guard monitors
/// the drive. Changes of direction are repeated in reverse order. The path is at most
/// `goal.distance_m` long and ends at a gap of the traversed path, or where the next pose is
/// neither on an arc that the vehicle can drive nor, up to 0.3 m beside it, on a curve onto the
/// next 3 m: map corrections tear the path. If that leaves less than 0.5 m, poses may be off such
/// an arc by more: the estimate of the poses may jitter. Driven ground that faces the other end, or
/// lies farther beside the robot, is reached by a planned path only. Blocked if it would be shorter
/// than 0.5 m. `turning_radius_m`: of the vehicle.
PlannedPath retrace(const PlanGoal& goal, const Pose2& T_odom_body, double turning_radius_m);

/// Maximum deviation from a pose of the traversed path at which the robot may continue from it. The
/// nearest pose of the lattice is within these limits.
inline constexpr double kOnPathM = 0.1;
inline constexpr double kOnPathRad = 0.1;

/// Clearance of points along the traversed path, where it is unknown: small, so that the robot
/// drives slowly unless KnownClearance shows more.
inline constexpr double kRetracedClearanceM = 0.1;

/// Extends a path that ends on the traversed path along it, as `retrace` does, from the last of its
/// poses that the end of the path is on.
void append_traversed_path(PlannedPath& path, const PlanGoal& goal, double turning_radius_m);

}  // namespace adit
