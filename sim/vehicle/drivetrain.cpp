// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/drivetrain.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

double approach(double value, double target, double change_max) {
  return value + std::clamp(target - value, -change_max, change_max);
}

/// The speed after `seconds` of approaching `target`: brakes to a slower speed, or to a stop if the
/// direction changes, and accelerates in the remaining time.
double follow(double speed, double target, double seconds, const VehicleModelParams& params) {
  const bool same_direction = speed * target > 0.0;
  const double brake_to = same_direction ? target : 0.0;
  if (std::abs(brake_to) < std::abs(speed)) {
    const double braking_s = std::abs(speed - brake_to) / params.braking_m_s2;
    if (braking_s >= seconds) return approach(speed, brake_to, params.braking_m_s2 * seconds);
    speed = brake_to;
    seconds -= braking_s;
  }
  return approach(speed, target, params.acceleration_m_s2 * seconds);
}

}  // namespace

Drivetrain::Drivetrain(const Vehicle& vehicle, const VehicleModelParams& params, std::int64_t utime)
    : vehicle_(vehicle),
      params_(params),
      utime_(utime),
      orders_({params.command_expiry_s, params.stop_order_expiry_s}) {}

void Drivetrain::command(const DriveCommand& command) { orders_.receive(command, utime_, utime_); }

void Drivetrain::command(const StopOrder& order) { orders_.receive(order, utime_, utime_); }

void Drivetrain::advance(double seconds) {
  const auto command = orders_.command(utime_);
  const double before = speed_m_s_;
  const double speed_max = vehicle_.speed_max_m_s;
  const double target = command ? std::clamp(command->speed_m_s, -speed_max, speed_max) : 0.0;
  speed_m_s_ = follow(before, target, seconds, params_);
  if (command) {
    const double curvature_max = 1.0 / vehicle_.turning_radius_m;
    curvature_1_m_ =
        approach(curvature_1_m_, std::clamp(command->curvature_1_m, -curvature_max, curvature_max),
                 params_.steering_rate_1_m_s * seconds);
  }
  wheel_distance_m_ = 0.5 * (before + speed_m_s_) * seconds;
  utime_ += std::llround(seconds * 1e6);
}

void Battery::draw(double speed_m_s, double rise, double seconds) {
  const double rolling = params_.rolling_resistance * std::sqrt(1.0 - rise * rise);
  const double lifting_m_s = rolling * std::abs(speed_m_s) + rise * speed_m_s;
  const double wheels_w = mass_kg_ * kGravityM_S2 * std::max(0.0, lifting_m_s);
  const double drawn_w = params_.power_idle_w + wheels_w / params_.drive_efficiency;
  energy_wh_ = std::max(0.0, energy_wh_ - drawn_w * seconds / 3600.0);
}

}  // namespace adit
