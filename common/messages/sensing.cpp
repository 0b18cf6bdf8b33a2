// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/sensing.hpp"

#include <algorithm>
#include <limits>

#include "common/messages/fields/sensing_fields.hpp"

namespace adit {

planar_lidar_t to_message(const LaserScan& scan) {
  planar_lidar_t message;
  message.utime = scan.utime;
  message.nranges = static_cast<std::int32_t>(scan.ranges_m.size());
  message.ranges = scan.ranges_m;
  message.nintensities = 0;
  message.rad0 = static_cast<float>(scan.angle_min_rad);
  message.radstep = static_cast<float>(scan.angle_step_rad);
  return message;
}

std::string_view rejection_reason(const LaserScan& scan) {
  if (static_cast<double>(scan.ranges_m.size()) * scan.angle_step_rad > kTwoTurnsRad) {
    return "bearings span more than two turns";
  }
  return {};
}

Result<LaserScan> from_message(const planar_lidar_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  LaserScan scan{message.utime, message.ranges, message.rad0, message.radstep};
  if (const auto reason = rejection_reason(scan); !reason.empty()) return Rejected{reason};
  return scan;
}

imu_t to_message(const ImuReading& reading) {
  imu_t message{};
  message.utime = reading.utime;
  Eigen::Map<Eigen::Vector3d>(message.angular_velocity_rad_s) = reading.angular_velocity;
  Eigen::Map<Eigen::Vector3d>(message.linear_acceleration_m_s2) = reading.linear_acceleration;
  message.orientation[0] = 1.0;
  return message;
}

Result<ImuReading> from_message(const imu_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return ImuReading{message.utime, Eigen::Vector3d(message.angular_velocity_rad_s),
                    Eigen::Vector3d(message.linear_acceleration_m_s2)};
}

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
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return WheelOdometry{message.utime, {message.x_m, message.y_m, message.theta_rad}};
}

tilt_t to_message(const TiltReading& reading) {
  tilt_t message;
  message.utime = reading.utime;
  message.angle_rad = reading.angle_rad;
  message.rate_rad_s = reading.rate_rad_s;
  return message;
}

Result<TiltReading> from_message(const tilt_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return TiltReading{message.utime, message.angle_rad, message.rate_rad_s};
}

tilt_command_t to_message(const TiltCommand& command) {
  tilt_command_t message;
  message.utime = command.utime;
  message.goal_rad = command.angle_rad;
  message.rate_max_rad_s = command.rate_rad_s;
  return message;
}

Result<TiltCommand> from_message(const tilt_command_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return TiltCommand{message.utime, message.goal_rad, message.rate_max_rad_s};
}

scan_request_t to_message(const ScanRequest& request) {
  scan_request_t message;
  message.utime = request.utime;
  message.id = request.id;
  message.laser = laser_channel(request.laser);
  return message;
}

Result<ScanRequest> from_message(const scan_request_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  const auto laser = laser_from_channel(message.laser);
  if (!laser) return Rejected{kUnknownLaser};
  return ScanRequest{message.utime, message.id, *laser};
}

gas_t to_message(const GasReading& reading) {
  gas_t message;
  message.utime = reading.utime;
  message.methane_share = reading.methane_share;
  message.oxygen_share = reading.oxygen_share;
  message.carbon_monoxide_share = reading.carbon_monoxide_share;
  return message;
}

Result<GasReading> from_message(const gas_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return GasReading{message.utime, message.methane_share, message.oxygen_share,
                    message.carbon_monoxide_share};
}

sinkage_t to_message(const SinkageReading& reading) {
  sinkage_t message;
  message.utime = reading.utime;
  std::ranges::copy(reading.depth_m, message.depth_m);
  return message;
}

Result<SinkageReading> from_message(const sinkage_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  SinkageReading reading{message.utime, {}};
  std::ranges::copy(message.depth_m, reading.depth_m.begin());
  return reading;
}

}  // namespace adit
