// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "common/geometry/pose2.hpp"
#include "common/sensing/vehicle_readings.hpp"

namespace adit {

/// How dead reckoning of the wheels departs from the truth: scale and drift that stay, and noise
/// that grows with the way. The defaults are those of a skidding four-wheel vehicle.
struct OdometryModel {
  double distance_scale = 1.015;
  double turn_scale = 0.97;
  double drift_rad_per_m = 0.0006;
  double distance_noise_m_per_sqrt_m = 0.01;
  double turn_noise_rad_per_sqrt_m = 0.004;
  double turn_noise_rad_per_sqrt_rad = 0.01;
};

/// Wheel odometry with its own stream of noise: same seed, same motion, same readings. It starts at
/// the origin of its own frame.
class SyntheticOdometry {
 public:
  SyntheticOdometry(const OdometryModel& model, std::uint64_t seed)
      : model_(model), random_(seed) {}

  /// The reading after a motion, given as the new pose in the frame of the old one.
  WheelOdometry advance(const Pose2& T_old_new, std::int64_t utime);

 private:
  OdometryModel model_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 T_wheel_body_;
};

}  // namespace adit
