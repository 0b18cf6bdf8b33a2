// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/messages/ros_messages.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/cloud/number_type.hpp"
#include "tools/ros/messages/ros_fields.hpp"

namespace adit {
namespace {

constexpr std::size_t kCovarianceOfPose = 36;
constexpr std::size_t kCovarianceOfVector = 9;

Eigen::Vector3d vector(RosFields& fields) {
  Eigen::Vector3d v;
  for (double& value : v) value = fields.f64();
  return v;
}

/// Position and orientation; an orientation that is none gives a NaN.
Eigen::Isometry3d pose(RosFields& fields) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = vector(fields);
  std::array<double, 4> q{};
  for (double& value : q) value = fields.f64();
  Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  rotation.normalize();  // zero stays zero
  T.linear() = rotation.squaredNorm() > 0.5
                   ? rotation.toRotationMatrix()
                   : Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return T;
}

/// Up to the ranges, which the two kinds of scan share.
RosLaserScan begin_of_scan(RosFields& fields) {
  RosLaserScan scan;
  const RosFields::Header header = fields.header();
  scan.utime = header.utime;
  scan.frame = header.frame;
  scan.angle_min_rad = fields.f32();
  fields.f32();  // angle_max
  scan.angle_step_rad = fields.f32();
  scan.time_increment_s = fields.f32();
  fields.f32();  // scan_time
  scan.range_min_m = fields.f32();
  scan.range_max_m = fields.f32();
  return scan;
}

/// A field of a point.
struct PointField {
  std::size_t offset = 0;
  NumberType type;
};

/// sensor_msgs/PointField: the types from 1 on.
std::optional<NumberType> point_field_type(std::uint8_t datatype) {
  using Kind = NumberType::Kind;
  constexpr std::array<NumberType, 8> kTypes{{{Kind::kSigned, 1},
                                              {Kind::kUnsigned, 1},
                                              {Kind::kSigned, 2},
                                              {Kind::kUnsigned, 2},
                                              {Kind::kSigned, 4},
                                              {Kind::kUnsigned, 4},
                                              {Kind::kFloat, 4},
                                              {Kind::kFloat, 8}}};
  if (datatype < 1 || datatype > kTypes.size()) return std::nullopt;
  return kTypes[datatype - 1U];
}

/// x, y and z among the fields of the points.
std::array<std::optional<PointField>, 3> coordinates(RosFields& fields) {
  constexpr std::size_t kFieldBytesMin = 13;
  std::array<std::optional<PointField>, 3> found;
  const std::size_t count = fields.count(kFieldBytesMin);
  for (std::size_t i = 0; i < count && fields.ok(); ++i) {
    const std::string name = fields.text();
    const std::size_t offset = fields.u32();
    const auto type = point_field_type(fields.u8());
    fields.u32();  // count
    if (name.size() != 1 || name[0] < 'x' || name[0] > 'z' || !type) continue;
    found[static_cast<std::size_t>(name[0] - 'x')] = PointField{offset, *type};
  }
  return found;
}

}  // namespace

std::optional<RosLaserScan> ros_laser_scan(const RosMessage& message) {
  RosFields fields(message.bytes, message.encoding);
  RosLaserScan scan = begin_of_scan(fields);
  scan.ranges_m = fields.floats();
  if (!fields.ok()) return std::nullopt;
  return scan;
}

std::optional<RosLaserScan> ros_multi_echo_laser_scan(const RosMessage& message) {
  RosFields fields(message.bytes, message.encoding);
  RosLaserScan scan = begin_of_scan(fields);
  const std::size_t beams = fields.count(sizeof(std::uint32_t));
  for (std::size_t i = 0; i < beams && fields.ok(); ++i) {
    const std::vector<float> echoes = fields.floats();
    scan.ranges_m.push_back(echoes.empty() ? std::numeric_limits<float>::infinity()
                                           : echoes.front());
  }
  if (!fields.ok()) return std::nullopt;
  return scan;
}

std::optional<RosPointCloud> ros_point_cloud(const RosMessage& message) {
  RosFields fields(message.bytes, message.encoding);
  RosPointCloud cloud;
  const RosFields::Header header = fields.header();
  cloud.utime = header.utime;
  cloud.frame = header.frame;
  const std::size_t height = fields.u32();
  const std::size_t width = fields.u32();
  const auto xyz = coordinates(fields);
  const bool big_endian = fields.u8() != 0;
  const std::size_t point_step = fields.u32();
  const std::size_t row_step = fields.u32();
  const auto data = fields.bytes();
  if (!fields.ok()) return std::nullopt;
  for (const auto& field : xyz) {
    if (!field || field->offset + field->type.bytes > point_step) return std::nullopt;
  }
  if (height == 0 || width == 0) return cloud;
  if (width > row_step / point_step || height > data.size() / row_step) return std::nullopt;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const auto point = data.subspan(row * row_step + column * point_step, point_step);
      Eigen::Vector3f p;
      for (int i = 0; i < 3; ++i) {
        const PointField& field = *xyz.at(static_cast<std::size_t>(i));
        p[i] = static_cast<float>(field.type.read(point.data() + field.offset, big_endian));
      }
      if (p.allFinite()) cloud.points.push_back(p);
    }
  }
  return cloud;
}

std::optional<RosOdometry> ros_odometry(const RosMessage& message) {
  RosFields fields(message.bytes, message.encoding);
  RosOdometry reading;
  const RosFields::Header header = fields.header();
  reading.utime = header.utime;
  reading.frame = header.frame;
  reading.child_frame = frame_name(fields.text());
  reading.T_frame_child = pose(fields);
  fields.skip_f64(kCovarianceOfPose);
  if (!fields.ok() || !reading.T_frame_child.matrix().allFinite()) return std::nullopt;
  return reading;
}

std::optional<RosImu> ros_imu(const RosMessage& message) {
  RosFields fields(message.bytes, message.encoding);
  RosImu reading;
  const RosFields::Header header = fields.header();
  reading.utime = header.utime;
  reading.frame = header.frame;
  fields.skip_f64(4 + kCovarianceOfVector);  // orientation
  reading.angular_velocity = vector(fields);
  fields.skip_f64(kCovarianceOfVector);
  reading.linear_acceleration = vector(fields);
  if (!fields.ok()) return std::nullopt;
  return reading;
}

std::optional<std::vector<RosTransform>> ros_transforms(const RosMessage& message) {
  constexpr std::size_t kTransformBytesMin = 72;
  RosFields fields(message.bytes, message.encoding);
  std::vector<RosTransform> all;
  const std::size_t count = fields.count(kTransformBytesMin);
  for (std::size_t i = 0; i < count && fields.ok(); ++i) {
    RosTransform transform;
    const RosFields::Header header = fields.header();
    transform.utime = header.utime;
    transform.parent = header.frame;
    transform.child = frame_name(fields.text());
    transform.T_parent_child = pose(fields);
    if (!transform.T_parent_child.matrix().allFinite()) return std::nullopt;
    all.push_back(std::move(transform));
  }
  if (!fields.ok()) return std::nullopt;
  return all;
}

}  // namespace adit
