// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "sim/laser/laser_model.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {

/// A laser without errors, with returns from all surfaces and readings in millimetres.
inline LaserParams perfect_laser() {
  LaserParams params;
  params.unit_m = 0.001;
  params.range_at_10_percent_m = 10'000.0;
  params.noise_sd_m = 0.0;
  params.offset_max_m = 0.0;
  return params;
}

/// Half the unit of perfect_laser(), and the error of single precision.
constexpr double kHalfMillimetre = 0.0005 + 0.00002;

/// Rotated by `yaw_rad`, then tilted, positive downward.
inline Eigen::Isometry3d laser_at(const Eigen::Vector3d& p_world, double yaw_rad = 0.0,
                                  double tilt_rad = 0.0) {
  return Eigen::Translation3d(p_world) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitY());
}

inline LaserScan scan_at_rest(LaserModel& laser, const Eigen::Isometry3d& T_world_laser) {
  return laser.measure([&](double) { return T_world_laser; }, 0);
}

inline double beam_angle(const LaserScan& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.angle_step_rad;
}

/// Range in the plan from the centre of a rectangle to its edge.
inline double range_in_rectangle(double length_m, double width_m, double angle_rad) {
  return std::min(length_m / 2.0 / std::abs(std::cos(angle_rad)),
                  width_m / 2.0 / std::abs(std::sin(angle_rad)));
}

}  // namespace adit
