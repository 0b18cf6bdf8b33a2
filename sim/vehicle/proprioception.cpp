// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/proprioception.hpp"

#include <cmath>

#include "sim/vehicle/vehicle_params.hpp"

namespace adit {
namespace {

Eigen::Vector3d draw(std::normal_distribution<double>& normal, std::mt19937_64& random,
                     double standard_deviation) {
  Eigen::Vector3d drawn;
  for (double& value : drawn) value = standard_deviation * normal(random);
  return drawn;
}

Eigen::Vector3d v_world(const BodyMotion& motion) {
  return motion.T_world_body.linear() * motion.v_body;
}

}  // namespace

void DeadReckoning::advance(double speed_m_s, double curvature_1_m, double seconds) {
  const double distance_m = speed_m_s * seconds;
  if (distance_m == 0.0) return;
  const double turn_rad = distance_m * steering_.turn_rad_per_m(curvature_1_m);
  const double spread = std::sqrt(std::abs(distance_m));
  const double distance_error = params_.distance_noise_m_per_sqrt_m * spread * normal_(random_);
  const double turn_error = params_.turn_noise_rad_per_sqrt_m * spread * normal_(random_);
  T_wheel_body_ =
      T_wheel_body_ * steering_.motion(params_.distance_scale * distance_m + distance_error,
                                       params_.turn_scale * turn_rad +
                                           params_.turn_bias_rad_per_m * distance_m + turn_error);
}

WheelOdometry DeadReckoning::reading(std::int64_t utime) const { return {utime, T_wheel_body_}; }

InertialUnit::InertialUnit(const ImuParams& params, std::uint64_t seed)
    : params_(params), random_(seed) {
  gyro_bias_ = draw(normal_, random_, params_.gyro_bias_sd_rad_s);
  accelerometer_bias_ = draw(normal_, random_, params_.accelerometer_bias_sd_m_s2);
}

ImuReading InertialUnit::measure(const BodyMotion& before, const BodyMotion& now, double seconds) {
  const Eigen::Matrix3d R_before_now =
      before.T_world_body.linear().transpose() * now.T_world_body.linear();
  const Eigen::AngleAxisd turn(R_before_now);
  const Eigen::Vector3d a_world = (v_world(now) - v_world(before)) / seconds;
  const Eigen::Vector3d f_world = a_world + kGravityM_S2 * Eigen::Vector3d::UnitZ();

  gyro_bias_ +=
      draw(normal_, random_, params_.gyro_bias_walk_rad_s_per_sqrt_s * std::sqrt(seconds));
  ImuReading reading;
  reading.utime = now.utime;
  reading.angular_velocity = turn.axis() * turn.angle() / seconds + gyro_bias_ +
                             draw(normal_, random_, params_.gyro_noise_rad_s);
  reading.linear_acceleration = now.T_world_body.linear().transpose() * f_world +
                                accelerometer_bias_ +
                                draw(normal_, random_, params_.accelerometer_noise_m_s2);
  return reading;
}

}  // namespace adit
