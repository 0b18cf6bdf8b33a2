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
    : vehicle_(vehicle), params_(params), utime_(utime) {}

void Drivetrain::command(const DriveCommand& command) {
  if (!std::isfinite(command.speed_m_s) || !std::isfinite(command.curvature_1_m)) return;
  const std::int64_t utime = std::min(command.utime, utime_);
  if (command_ && utime < command_->utime) return;
  const double curvature_max = 1.0 / vehicle_.turning_radius_m;
  command_ = {utime, std::clamp(command.speed_m_s, -vehicle_.speed_max_m_s, vehicle_.speed_max_m_s),
              std::clamp(command.curvature_1_m, -curvature_max, curvature_max)};
}

void Drivetrain::command(const StopOrder& order) {
  std::int64_t utime = std::min(order.utime, utime_);
  if (order_ && order.stopped) utime = std::max(utime, order_->utime);
  if (order_ && !order.stopped && utime <= order_->utime) return;
  order_ = {utime, order.stopped, order.reason};
  order_received_utime_ = utime_;
}

void Drivetrain::advance(double seconds) {
  const bool braking = stopped() || expired();
  const double before = speed_m_s_;
  speed_m_s_ = follow(before, braking ? 0.0 : command_->speed_m_s, seconds, params_);
  if (!braking) {
    curvature_1_m_ =
        approach(curvature_1_m_, command_->curvature_1_m, params_.steering_rate_1_m_s * seconds);
  }
  wheel_distance_m_ = 0.5 * (before + speed_m_s_) * seconds;
  utime_ += std::llround(seconds * 1e6);
}

bool Drivetrain::stopped() const {
  return order_ && (order_->stopped || is_past(order_received_utime_, params_.stop_order_expiry_s));
}

bool Drivetrain::expired() const {
  return !command_ || is_past(command_->utime, params_.command_expiry_s);
}

bool Drivetrain::is_past(std::int64_t utime, double expiry_s) const {
  return seconds(utime_ - utime) >= expiry_s;
}

void Battery::draw(double speed_m_s, double rise, double seconds) {
  const double rolling = params_.rolling_resistance * std::sqrt(1.0 - rise * rise);
  const double lifting_m_s = rolling * std::abs(speed_m_s) + rise * speed_m_s;
  const double wheels_w = mass_kg_ * kGravityM_S2 * std::max(0.0, lifting_m_s);
  const double drawn_w = params_.power_idle_w + wheels_w / params_.drive_efficiency;
  energy_wh_ = std::max(0.0, energy_wh_ - drawn_w * seconds / 3600.0);
}

}  // namespace adit
