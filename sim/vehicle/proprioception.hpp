// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "common/sensing/vehicle_readings.hpp"
#include "sim/vehicle/steering.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Dead reckoning by what the wheels and the steering say (VehicleState), with errors of its own:
/// scales, and noise whose variance grows with the way. Starts at the origin of its frame.
class DeadReckoning {
 public:
  /// `vehicle` says how it is steered.
  DeadReckoning(const WheelOdometryParams& params, std::uint64_t seed, const Vehicle& vehicle = {})
      : params_(params), steering_(vehicle), random_(seed) {}

  /// `speed_m_s` and `curvature_1_m` were so for `seconds`.
  void advance(double speed_m_s, double curvature_1_m, double seconds);
  [[nodiscard]] WheelOdometry reading(std::int64_t utime) const;

 private:
  WheelOdometryParams params_;
  Steering steering_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 T_wheel_body_;
};

/// Gyroscopes and accelerometers with noise and biases.
class InertialUnit {
 public:
  InertialUnit(const ImuParams& params, std::uint64_t seed);

  /// `seconds` since the last reading, more than none; what is measured is the mean motion since
  /// then: angular velocity, and specific force, which is upward 9.81 m/s² at rest.
  ImuReading measure(const BodyMotion& before, const BodyMotion& now, double seconds);

 private:
  ImuParams params_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d gyro_bias_{0.0, 0.0, 0.0};
  Eigen::Vector3d accelerometer_bias_{0.0, 0.0, 0.0};
};

}  // namespace adit
