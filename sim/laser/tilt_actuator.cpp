// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/tilt_actuator.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

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
