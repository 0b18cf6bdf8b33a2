// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <numbers>

#include <Eigen/Geometry>

#include "common/geometry/pose2.hpp"
#include "common/types/cloud.hpp"
#include "common/types/vehicle.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Parameters of one sweep of a tilting laser on a vehicle at rest, from up to down.
struct TiltSweep {
  LaserMount mount = groundhog_lasers().front;
  LaserParams laser;
  int scans = 240;
  double tilt_from_rad = -std::numbers::pi / 6.0;  ///< of the first scan; negative tilts up
  double tilt_to_rad = std::numbers::pi / 6.0;     ///< of the last one
  std::uint64_t seed = 1;                          ///< of the noise
};

/// Level pose of the body at a pose in the plan, its origin on the bare floor of the truth. Throws
/// std::invalid_argument if that is in rock.
Eigen::Isometry3d level_on_floor(const World& world, const Pose2& T_world_plan);

/// Pose of the body on its wheels. Throws std::invalid_argument with the reason if the vehicle
/// cannot stand there.
Eigen::Isometry3d standing(const Site& site, const Pose2& T_world_plan,
                           const Vehicle& vehicle = {});

/// The 3D scan from a pose, without pose errors: odom is world. The tilt changes between scans and
/// not within one, so that all beams of a line have the same origin.
Cloud tilt_sweep(const Site& site, const Eigen::Isometry3d& T_world_body,
                 const TiltSweep& sweep = {});

}  // namespace adit
