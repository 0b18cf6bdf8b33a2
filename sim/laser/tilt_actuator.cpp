// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/tilt_actuator.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// Mean rate times time, which is exact for a constant acceleration.
double displacement(double rate_from, double rate_to, double seconds) {
  return (rate_from + rate_to) / 2.0 * seconds;
}

}  // namespace

TrapezoidalMotion::TrapezoidalMotion(const State& start, double goal, double rate_max,
                                     double acceleration)
    : start_(start), goal_(goal), acceleration_(acceleration) {
  const double stop = start.position + start.rate * std::abs(start.rate) / (2.0 * acceleration);
  direction_ = goal >= stop ? 1.0 : -1.0;
  const double rate = direction_ * start.rate;
  const double distance = direction_ * (goal - start.position);
  // Acceleration to the peak and deceleration from it cover the complete distance.
  const double peak2 = acceleration * distance + rate * rate / 2.0;
  peak_rate_ = std::min(rate_max, std::sqrt(std::max(0.0, peak2)));
  to_peak_s_ = std::abs(peak_rate_ - rate) / acceleration;
  const double rest = distance - displacement(rate, peak_rate_, to_peak_s_) -
                      displacement(peak_rate_, 0.0, peak_rate_ / acceleration);
  at_peak_s_ = peak_rate_ > 0.0 ? std::max(0.0, rest / peak_rate_) : 0.0;
}

TrapezoidalMotion::State TrapezoidalMotion::at(double seconds) const {
  if (seconds < to_peak_s_) {
    const double peak = direction_ * peak_rate_;
    const double rate = start_.rate + (peak - start_.rate) * seconds / to_peak_s_;
    return {start_.position + displacement(start_.rate, rate, seconds), rate};
  }
  // Computed backward from the goal, so that the goal is reached exactly.
  const double braking_s = peak_rate_ / acceleration_;
  const double left_s = to_peak_s_ + at_peak_s_ + braking_s - seconds;
  if (left_s <= 0.0) return {goal_, 0.0};
  const double rate = direction_ * std::min(peak_rate_, acceleration_ * left_s);
  const double cruise_s = std::max(0.0, left_s - braking_s);
  const double left =
      direction_ * displacement(0.0, std::abs(rate), std::min(left_s, braking_s)) + rate * cruise_s;
  return {goal_ - left, rate};
}

void TiltActuator::command(const TiltCommand& command) {
  const bool finite = std::isfinite(command.angle_rad) && std::isfinite(command.rate_rad_s);
  if (!finite || command.rate_rad_s <= 0.0) return;
  const double goal_rad =
      std::clamp(command.angle_rad, params_.angle_min_rad, params_.angle_max_rad);
  const double rate_rad_s = std::min(command.rate_rad_s, params_.rate_max_rad_s);
  motion_ = TrapezoidalMotion(state(), goal_rad, rate_rad_s, params_.acceleration_rad_s2);
  since_command_s_ = 0.0;
}

void TiltActuator::advance(double seconds) { since_command_s_ += seconds; }

TiltReading TiltActuator::reading(std::int64_t utime) const {
  const auto [angle_rad, rate_rad_s] = state();
  const double step = params_.encoder_step_rad;
  const double read_rad = step > 0.0 ? std::round(angle_rad / step) * step : angle_rad;
  return {utime, read_rad, rate_rad_s};
}

}  // namespace adit
