// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/ros2/ros2_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "common/files/little_endian.hpp"
#include "tools/export/ros2/cdr_writer.hpp"

namespace adit::ros2 {
namespace {

constexpr std::uint8_t kFloat32 = 7;  // of sensor_msgs/PointField
constexpr int kCovarianceOfPose = 36;
constexpr int kCovarianceOfVector = 9;

void add_zeros(CdrWriter& message, int count) {
  for (int i = 0; i < count; ++i) message.f64(0.0);
}

void add_vector(CdrWriter& message, const Eigen::Vector3d& v) {
  for (const double value : v) message.f64(value);
}

void add_rotation(CdrWriter& message, const Eigen::Quaterniond& q) {
  message.f64(q.x()).f64(q.y()).f64(q.z()).f64(q.w());
}

/// geometry_msgs/Pose and Transform have the same layout.
void add_pose(CdrWriter& message, const Eigen::Isometry3d& T) {
  add_vector(message, T.translation());
  add_rotation(message, Eigen::Quaterniond(T.linear()));
}

double known(double rate) { return std::isfinite(rate) ? rate : 0.0; }

}  // namespace

/// In the order of measurement: a clockwise scan has a negative angle_increment.
std::string laser_scan(const LaserScan& scan, const LaserMount& mount, const std::string& frame) {
  const ScanTiming& timing = mount.timing;
  const double step_rad = scan.angle_step_rad;
  const double first_rad = scan.angle_min_rad;
  const double last_rad = first_rad + (static_cast<double>(scan.ranges_m.size()) - 1.0) * step_rad;
  // One number cannot say that the odd beams are measured a turn after the even ones: 0, unknown.
  const double increment_s =
      timing.turns(step_rad) == 1 ? timing.last_beam_time_s(2, step_rad) : 0.0;
  std::vector<float> ranges_m = scan.ranges_m;
  if (timing.clockwise) std::ranges::reverse(ranges_m);
  CdrWriter message;
  message.header(scan.utime, frame)
      .f32(static_cast<float>(timing.clockwise ? last_rad : first_rad))
      .f32(static_cast<float>(timing.clockwise ? first_rad : last_rad))
      .f32(static_cast<float>(timing.clockwise ? -step_rad : step_rad))
      .f32(static_cast<float>(increment_s))
      .f32(static_cast<float>(timing.scan_period_s(step_rad)))
      .f32(static_cast<float>(mount.range_min_m))
      .f32(static_cast<float>(mount.range_max_m))
      .u32(ranges_m.size());
  for (const float range : ranges_m) message.f32(range);
  return message.u32(0).bytes();  // intensities
}

std::string point_cloud(const Cloud& cloud, const std::string& frame) {
  constexpr std::size_t kPointBytes = 3 * sizeof(float);
  const Eigen::Isometry3f T_odom_level = in_space(cloud.T_odom_level, cloud.z_odom_m).cast<float>();
  std::string data;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p_level : line.points) {
      const Eigen::Vector3f p_odom = T_odom_level * p_level;
      for (const float value : p_odom)
        append_little_endian(data, std::bit_cast<std::uint32_t>(value), sizeof(float));
    }
  }
  CdrWriter message;
  message.header(cloud.utime, frame).u32(1).u32(data.size() / kPointBytes).u32(3);
  std::size_t offset = 0;
  for (const char* const name : {"x", "y", "z"}) {
    message.text(name).u32(offset).u8(kFloat32).u32(1);
    offset += sizeof(float);
  }
  message.u8(0).u32(kPointBytes).u32(data.size());
  return message.bytes(data).u8(1).bytes();  // dense: no point is invalid
}

std::string odometry(const wheel_odometry_t& reading, const std::string& frame,
                     const std::string& child_frame) {
  CdrWriter message;
  message.header(reading.utime, frame).text(child_frame);
  add_pose(message, in_space(Pose2{reading.x_m, reading.y_m, reading.theta_rad}));
  add_zeros(message, kCovarianceOfPose);
  add_vector(message, {known(reading.forward_m_s), 0.0, 0.0});
  add_vector(message, {0.0, 0.0, known(reading.yaw_rate_rad_s)});
  add_zeros(message, kCovarianceOfPose);
  return message.bytes();
}

std::string imu(const imu_t& reading, const std::string& frame) {
  CdrWriter message;
  message.header(reading.utime, frame);
  const double* const q = reading.orientation;  // w x y z
  const bool known_orientation = reading.has_orientation != 0;
  add_rotation(message, known_orientation ? Eigen::Quaterniond(q[0], q[1], q[2], q[3])
                                          : Eigen::Quaterniond::Identity());
  message.f64(known_orientation ? 0.0 : -1.0);
  add_zeros(message, kCovarianceOfVector - 1);
  add_vector(message, Eigen::Vector3d(reading.angular_velocity_rad_s));
  add_zeros(message, kCovarianceOfVector);
  add_vector(message, Eigen::Vector3d(reading.linear_acceleration_m_s2));
  add_zeros(message, kCovarianceOfVector);
  return message.bytes();
}

std::string path(const PlannedPath& path, const std::string& frame) {
  CdrWriter message;
  message.header(path.utime, frame).u32(path.points.size());
  for (const PathPoint& point : path.points) {
    message.header(path.utime, frame);
    add_pose(message, in_space(point.T_odom_body));
  }
  return message.bytes();
}

std::string pose(std::int64_t utime, const Eigen::Isometry3d& T, const std::string& frame) {
  CdrWriter message;
  message.header(utime, frame);
  add_pose(message, T);
  return message.bytes();
}

std::string transforms(const std::vector<StampedTransform>& transforms) {
  CdrWriter message;
  message.u32(transforms.size());
  for (const StampedTransform& transform : transforms) {
    message.header(transform.utime, transform.parent).text(transform.child);
    add_pose(message, transform.T_parent_child);
  }
  return message.bytes();
}

std::string occupancy_grid(const OccupancyCells& grid, const std::string& frame) {
  CdrWriter message;
  message.header(grid.utime, frame)
      .time(grid.utime)
      .f32(static_cast<float>(grid.cell_m))
      .u32(grid.columns)
      .u32(grid.rows);
  add_pose(message, in_space(grid.T_map_grid));
  return message.bytes(grid.cells).bytes();
}

}  // namespace adit::ros2
