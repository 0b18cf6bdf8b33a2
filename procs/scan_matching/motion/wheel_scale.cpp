// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/wheel_scale.hpp"

#include <cmath>

namespace adit {

double WheelScale::sd() const { return std::sqrt(variance_); }

void WheelScale::add(const Pose2& wheels_step, double level_share,
                     const std::optional<Pose2>& scans_step) {
  const double direction = std::copysign(1.0, wheels_step.x);
  const double step_m = level_share * std::abs(wheels_step.x);
  variance_ += params_.walk_per_sqrt_m * params_.walk_per_sqrt_m * step_m;
  if (!scans_step) {
    end_span();
    return;
  }
  wheels_m_ += step_m;
  scans_m_ += direction * scans_step->x;
  if (wheels_m_ >= params_.span_m) end_span();
}

/// A stretch that ends early is compared over what it has.
void WheelScale::end_span() {
  const double wheels_m = wheels_m_;
  const double error_m = scans_m_ - scale_ * wheels_m;
  wheels_m_ = 0.0;
  scans_m_ = 0.0;
  if (wheels_m <= 0.0 || wheels_m < params_.span_min_m) return;
  const double noise = params_.m_per_sqrt_m * params_.m_per_sqrt_m * wheels_m +
                       params_.match_sd_m * params_.match_sd_m;
  const double innovation = variance_ * wheels_m * wheels_m + noise;
  if (error_m * error_m > params_.deviation_max * params_.deviation_max * innovation) return;
  const double gain = variance_ * wheels_m / innovation;
  scale_ += gain * error_m;
  variance_ *= noise / innovation;
}

}  // namespace adit
