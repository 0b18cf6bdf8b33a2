// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/wheel_odometry.hpp"

#include <array>
#include <limits>

#include "common/messages/checks.hpp"

namespace adit {

wheel_odometry_t to_message(const WheelOdometry& odometry) {
  wheel_odometry_t message;
  message.utime = odometry.utime;
  message.x_m = odometry.T_wheel_body.x;
  message.y_m = odometry.T_wheel_body.y;
  message.theta_rad = odometry.T_wheel_body.theta;
  message.forward_m_s = std::numeric_limits<double>::quiet_NaN();
  message.yaw_rate_rad_s = std::numeric_limits<double>::quiet_NaN();
  return message;
}

Result<WheelOdometry> from_message(const wheel_odometry_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!all_finite(std::array{message.x_m, message.y_m, message.theta_rad})) {
    return Refused{"pose is not finite"};
  }
  return WheelOdometry{message.utime, {message.x_m, message.y_m, message.theta_rad}};
}

}  // namespace adit
