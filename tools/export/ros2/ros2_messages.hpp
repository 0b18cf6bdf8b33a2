// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "common/messages/sensing.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/types/cloud.hpp"
#include "common/types/planned_path.hpp"

/// Messages of ROS 2 in CDR (common_interfaces and geometry2 of Humble; the layouts have been the
/// same since Foxy), and their definitions.
namespace adit::ros2 {

/// The definition of a type with those that it contains, as MCAP wants it ("ros2msg"). Known are
/// those below.
std::string definition(const std::string& type);

inline constexpr const char* kLaserScan = "sensor_msgs/msg/LaserScan";
inline constexpr const char* kPointCloud2 = "sensor_msgs/msg/PointCloud2";
inline constexpr const char* kImu = "sensor_msgs/msg/Imu";
inline constexpr const char* kOdometry = "nav_msgs/msg/Odometry";
inline constexpr const char* kPath = "nav_msgs/msg/Path";
inline constexpr const char* kOccupancyGrid = "nav_msgs/msg/OccupancyGrid";
inline constexpr const char* kPoseStamped = "geometry_msgs/msg/PoseStamped";
inline constexpr const char* kTfMessage = "tf2_msgs/msg/TFMessage";

std::string laser_scan(const LaserScan& scan, const LaserMount& mount, const std::string& frame);
/// The points of a 3D scan in odom.
std::string point_cloud(const Cloud& cloud, const std::string& frame);
/// Without covariances, which our message does not have; an unknown rate is 0.
std::string odometry(const wheel_odometry_t& reading, const std::string& frame,
                     const std::string& child_frame);
/// Without orientation if the reading has none: its covariance is −1 then, by the definition.
std::string imu(const imu_t& reading, const std::string& frame);
std::string path(const PlannedPath& path, const std::string& frame);
std::string pose(std::int64_t utime, const Eigen::Isometry3d& T, const std::string& frame);

struct StampedTransform {
  std::int64_t utime = 0;
  std::string parent;
  std::string child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};
std::string transforms(const std::vector<StampedTransform>& transforms);

/// Occupancy by rows from the origin, 0 to 100, −1 unknown.
struct OccupancyCells {
  std::int64_t utime = 0;
  double cell_m = 0.1;
  Pose2 T_map_grid;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::string cells;  ///< a byte each
};
std::string occupancy_grid(const OccupancyCells& grid, const std::string& frame);

}  // namespace adit::ros2
