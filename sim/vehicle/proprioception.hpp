// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "common/sensing/vehicle_readings.hpp"
#include "sim/vehicle/kinematics.hpp"
#include "sim/vehicle/vehicle_model.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Dead reckoning from wheel speed and steering (VehicleState), with scale errors, a bias of the
/// heading, and noise whose variance grows with the distance. Starts at the origin of its frame.
class DeadReckoning {
 public:
  /// `vehicle` defines the steering.
  DeadReckoning(const WheelOdometryParams& params, std::uint64_t seed, const Vehicle& vehicle = {})
      : params_(params), steering_(vehicle), random_(seed) {}

  /// Integrates a constant speed and curvature over `seconds`.
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

  /// Measures the mean motion since the last reading, `seconds` > 0 before: angular velocity, and
  /// specific force, which is 9.81 m/s² upward at rest.
  ImuReading measure(const BodyMotion& before, const BodyMotion& now, double seconds);

 private:
  ImuParams params_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d gyro_bias_{0.0, 0.0, 0.0};
  Eigen::Vector3d accelerometer_bias_{0.0, 0.0, 0.0};
};

}  // namespace adit
