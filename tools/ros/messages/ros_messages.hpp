// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

/// The messages of ROS that logs are converted from, in ROS 1 and ROS 2 (common_interfaces,
/// geometry2): those fields that are used. Each function returns nothing for bytes that are no such
/// message, or have a rotation that is none.
namespace adit {

namespace ros_types {

inline constexpr std::string_view kLaserScan = "sensor_msgs/LaserScan";
inline constexpr std::string_view kMultiEchoLaserScan = "sensor_msgs/MultiEchoLaserScan";
inline constexpr std::string_view kPointCloud2 = "sensor_msgs/PointCloud2";
inline constexpr std::string_view kOdometry = "nav_msgs/Odometry";
inline constexpr std::string_view kImu = "sensor_msgs/Imu";
inline constexpr std::string_view kTransforms = "tf2_msgs/TFMessage";
inline constexpr std::string_view kEarlyTransforms = "tf/tfMessage";

}  // namespace ros_types

/// A message as it is in a bag.
struct RosMessage {
  std::span<const std::uint8_t> bytes;
  std::string_view encoding;  ///< "ros1" or "cdr"
};

/// Also of a MultiEchoLaserScan: its first echoes, infinite where a beam has none.
struct RosLaserScan {
  std::int64_t utime = 0;
  std::string frame;
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;    ///< negative if the beams are clockwise
  double time_increment_s = 0.0;  ///< from one beam to the next; 0 where the driver does not say
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
};

struct RosPointCloud {
  std::int64_t utime = 0;
  std::string frame;
  std::vector<Eigen::Vector3f> points;  ///< finite, in the frame of the sensor [m]
};

struct RosOdometry {
  std::int64_t utime = 0;
  std::string frame;
  std::string child_frame;
  Eigen::Isometry3d T_frame_child = Eigen::Isometry3d::Identity();
};

struct RosImu {
  std::int64_t utime = 0;
  std::string frame;
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();     ///< [rad/s]
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< [m/s²]
};

struct RosTransform {
  std::int64_t utime = 0;
  std::string parent;
  std::string child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};

std::optional<RosLaserScan> ros_laser_scan(const RosMessage& message);
std::optional<RosLaserScan> ros_multi_echo_laser_scan(const RosMessage& message);
/// Needs fields x, y and z of 4 or 8 bytes.
std::optional<RosPointCloud> ros_point_cloud(const RosMessage& message);
std::optional<RosOdometry> ros_odometry(const RosMessage& message);
std::optional<RosImu> ros_imu(const RosMessage& message);
std::optional<std::vector<RosTransform>> ros_transforms(const RosMessage& message);

}  // namespace adit
