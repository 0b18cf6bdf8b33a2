// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/synthetic_odometry.hpp"

#include <cmath>

namespace adit {

WheelOdometry SyntheticOdometry::advance(const Pose2& T_old_new, std::int64_t utime) {
  const double distance = T_old_new.translation().norm();
  const double turn = std::abs(T_old_new.theta);
  const double along_noise = model_.distance_noise_m_per_sqrt_m * std::sqrt(distance);
  const double turn_noise = std::hypot(model_.turn_noise_rad_per_sqrt_m * std::sqrt(distance),
                                       model_.turn_noise_rad_per_sqrt_rad * std::sqrt(turn));
  Pose2 measured;
  measured.x = model_.distance_scale * T_old_new.x + along_noise * normal_(random_);
  measured.y = model_.distance_scale * T_old_new.y;
  measured.theta = model_.turn_scale * T_old_new.theta + model_.drift_rad_per_m * distance +
                   turn_noise * normal_(random_);
  T_wheel_body_ = T_wheel_body_ * measured;
  return {utime, T_wheel_body_};
}

}  // namespace adit
