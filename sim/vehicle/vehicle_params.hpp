// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"

namespace adit {

inline constexpr double kGravityM_S2 = 9.81;

/// Dynamics and errors of the simulated vehicle.
struct VehicleModelParams {
  double acceleration_m_s2 = 0.3;
  double braking_m_s2 = 0.8;         ///< on a stop order, an expired command, or a slower one
  double steering_rate_1_m_s = 0.5;  ///< greatest change of the curvature per second
  double command_expiry_s = 0.25;
  double stop_order_expiry_s = 0.5;  ///< maximum interval of stop orders, after the first one
  double slip_share = 0.03;          ///< mean fraction of the speed lost on firm ground
  double slip_sd = 0.02;             ///< of slip_share, with a correlation length of 1 m
  double side_slip_sd_rad = 0.01;    ///< of the direction of motion relative to the steering
  double battery_wh = 5000.0;
  double power_idle_w = 200.0;  ///< drawn constantly
  double rolling_resistance =
      0.15;                       ///< force against the wheels, as a fraction of the normal force
  double drive_efficiency = 0.5;  ///< fraction of the power drawn that reaches the wheels

  template <class V>
  void visit(V& v) {
    v("acceleration_m_s2", acceleration_m_s2, above(0.0));
    v("braking_m_s2", braking_m_s2, above(0.0));
    v("steering_rate_1_m_s", steering_rate_1_m_s, above(0.0));
    v("command_expiry_s", command_expiry_s, above(0.0));
    v("stop_order_expiry_s", stop_order_expiry_s, above(0.0));
    v("slip_share", slip_share, within(0.0, 0.9));
    v("slip_sd", slip_sd, within(0.0, 0.5));
    v("side_slip_sd_rad", side_slip_sd_rad, within(0.0, 0.5));
    v("battery_wh", battery_wh, above(0.0));
    v("power_idle_w", power_idle_w, at_least(0.0));
    v("rolling_resistance", rolling_resistance, at_least(0.0));
    v("drive_efficiency", drive_efficiency, above_up_to(0.0, 1.0));
  }
};

/// Errors of the wheel odometry. By default it is calibrated for the mean slip up to an error of 1
/// %: 0.98 / (1 − 0.03).
struct WheelOdometryParams {
  bool present = true;
  double distance_scale = 0.98;  ///< of the distance that the wheels rolled
  double turn_scale = 0.97;
  double turn_bias_rad_per_m = 0.0;  ///< systematic turn of the heading, to the left
  double distance_noise_m_per_sqrt_m = 0.01;
  double turn_noise_rad_per_sqrt_m = 0.005;

  template <class V>
  void visit(V& v) {
    v("present", present);
    v("distance_scale", distance_scale, above(0.0));
    v("turn_scale", turn_scale, above(0.0));
    v("turn_bias_rad_per_m", turn_bias_rad_per_m, within(-0.2, 0.2));
    v("distance_noise_m_per_sqrt_m", distance_noise_m_per_sqrt_m, at_least(0.0));
    v("turn_noise_rad_per_sqrt_m", turn_noise_rad_per_sqrt_m, at_least(0.0));
  }
};

/// Errors of the inertial unit. Defaults are those of a small unit of vibrating gyroscopes.
struct ImuParams {
  bool present = true;
  double gyro_noise_rad_s = 0.003;     ///< of each reading, normal
  double gyro_bias_sd_rad_s = 0.0005;  ///< drawn at the start
  double gyro_bias_walk_rad_s_per_sqrt_s = 0.00002;
  double accelerometer_noise_m_s2 = 0.03;  ///< of each reading, normal
  double accelerometer_bias_sd_m_s2 = 0.02;

  template <class V>
  void visit(V& v) {
    v("present", present);
    v("gyro_noise_rad_s", gyro_noise_rad_s, at_least(0.0));
    v("gyro_bias_sd_rad_s", gyro_bias_sd_rad_s, at_least(0.0));
    v("gyro_bias_walk_rad_s_per_sqrt_s", gyro_bias_walk_rad_s_per_sqrt_s, at_least(0.0));
    v("accelerometer_noise_m_s2", accelerometer_noise_m_s2, at_least(0.0));
    v("accelerometer_bias_sd_m_s2", accelerometer_bias_sd_m_s2, at_least(0.0));
  }
};

}  // namespace adit
