// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/imu_reading.hpp"

#include "common/messages/checks.hpp"

namespace adit {

imu_t to_message(const ImuReading& reading) {
  imu_t message{};
  message.utime = reading.utime;
  Eigen::Map<Eigen::Vector3d>(message.angular_velocity_rad_s) = reading.angular_velocity;
  Eigen::Map<Eigen::Vector3d>(message.linear_acceleration_m_s2) = reading.linear_acceleration;
  message.orientation[0] = 1.0;
  return message;
}

Result<ImuReading> from_message(const imu_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!all_finite(message.angular_velocity_rad_s)) return Refused{"angular velocity is not finite"};
  if (!all_finite(message.linear_acceleration_m_s2)) return Refused{"acceleration is not finite"};
  return ImuReading{message.utime, Eigen::Vector3d(message.angular_velocity_rad_s),
                    Eigen::Vector3d(message.linear_acceleration_m_s2)};
}

}  // namespace adit
