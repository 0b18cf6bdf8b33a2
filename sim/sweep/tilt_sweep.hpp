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

/// One tilt of a laser of a vehicle at rest, from looking up to looking down.
struct TiltSweep {
  LaserMount mount = groundhog_lasers().front;
  LaserParams laser;
  int scans = 240;
  double tilt_from_rad = -std::numbers::pi / 6.0;  ///< of the first scan, negative looks up
  double tilt_to_rad = std::numbers::pi / 6.0;     ///< of the last one
  std::uint64_t seed = 1;                          ///< of the noise
};

/// The body at a place of the plan, level, its origin on the bare floor of the truth. Throws
/// std::invalid_argument where that is in rock.
Eigen::Isometry3d level_on_floor(const World& world, const Pose2& T_world_plan);

/// The body as its wheels hold it. Throws std::invalid_argument, with the reason, where it does
/// not stand.
Eigen::Isometry3d standing(const Site& site, const Pose2& T_world_plan,
                           const Vehicle& vehicle = {});

/// What the sweep sees from there, placed without error: odom is world. The tilt changes from scan
/// to scan and not within one, so that the origin of a line is that of all its beams.
Cloud tilt_sweep(const Site& site, const Eigen::Isometry3d& T_world_body,
                 const TiltSweep& sweep = {});

}  // namespace adit
