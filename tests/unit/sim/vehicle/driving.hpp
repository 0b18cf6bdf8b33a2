// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "sim/vehicle/vehicle_model.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {

constexpr double kStepS = 0.01;

/// Parameters without slip and dynamics.
inline VehicleModelParams without_slip() {
  VehicleModelParams params;
  params.slip_share = params.slip_sd = params.side_slip_sd_rad = 0.0;
  return params;
}

/// Commands and advances the vehicle until it fails.
inline void drive(VehicleModel& vehicle, double speed_m_s, double curvature_1_m, double seconds) {
  const long steps = std::lround(seconds / kStepS);
  for (long i = 0; i < steps && !vehicle.failure(); ++i) {
    vehicle.command(DriveCommand{vehicle.motion().utime, speed_m_s, curvature_1_m});
    vehicle.advance(kStepS);
  }
}

/// Roll, pitch and heading of the body: turns about x, then y, then z of world [rad].
inline Eigen::Vector3d roll_pitch_heading(const VehicleModel& vehicle) {
  const Eigen::Matrix3d R = vehicle.motion().T_world_body.linear();
  return {std::atan2(R(2, 1), R(2, 2)), -std::asin(R(2, 0)), std::atan2(R(1, 0), R(0, 0))};
}

/// The failure of a vehicle that drives straight ahead from `start` without slip; "none" if it has
/// none within `seconds`.
inline std::string failure_ahead(World world, double seconds = 30.0, const Pose2& start = {}) {
  world.T_world_start = start;
  const Site site(std::move(world));
  VehicleModel vehicle(site, {}, without_slip(), 1, 0);
  drive(vehicle, 0.5, 0.0, seconds);
  return vehicle.failure().value_or("none");
}

}  // namespace adit
