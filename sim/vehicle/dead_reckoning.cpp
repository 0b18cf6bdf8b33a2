// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/vehicle/proprioception.hpp"

namespace adit {

void DeadReckoning::advance(double speed_m_s, double curvature_1_m, double seconds) {
  const double way_m = speed_m_s * seconds;
  if (way_m == 0.0) return;
  const double turn_rad = way_m * steering_.turn_rad_per_m(curvature_1_m);
  const double spread = std::sqrt(std::abs(way_m));
  const double distance_error = params_.distance_noise_m_per_sqrt_m * spread * normal_(random_);
  const double turn_error = params_.turn_noise_rad_per_sqrt_m * spread * normal_(random_);
  T_wheel_body_ = T_wheel_body_ * steering_.motion(params_.distance_scale * way_m + distance_error,
                                                   params_.turn_scale * turn_rad + turn_error);
}

WheelOdometry DeadReckoning::reading(std::int64_t utime) const { return {utime, T_wheel_body_}; }

}  // namespace adit
