// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for bags of ROS: the containers, and the messages in them.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/targets.hpp"
#include "tests/support/bags/ros1_bag_writer.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/export/mcap_writer.hpp"
#include "tools/export/ros2/ros2_messages.hpp"
#include "tools/ros/bag/mcap_reader.hpp"
#include "tools/ros/bag/ros1_bag_reader.hpp"
#include "tools/ros/import/level_scan.hpp"
#include "tools/ros/messages/ros_messages.hpp"

namespace adit::fuzz {
namespace {

constexpr std::int64_t kUtime = 1'700'000'000'000'000;
// The samples have less content than this, also if damage lengthens a run of LZ4; a damaged size
// must not make more of it.
constexpr std::size_t kContentMax = 10'000'000;

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

Bytes sample_ros1(const std::string& compression) {
  test::Ros1BagWriter bag(compression);
  for (int i = 0; i < 6; ++i) {
    const std::vector<float> ranges(20, static_cast<float>(i));
    bag.write("/scan", "sensor_msgs/LaserScan", kUtime + i,
              test::ros1_laser_scan(kUtime + i, "laser", ranges));
    if (i % 3 == 2) bag.end_chunk();
  }
  return bag.closed();
}

Bytes sample_mcap() {
  const test::ScratchFolder folder;
  McapWriter writer(folder / "a.mcap", "ros2");
  const auto id = writer.add_channel("/scan", "cdr", {"sensor_msgs/msg/LaserScan", "ros2msg", ""});
  for (int i = 0; i < 6; ++i) {
    writer.write(id, kUtime + i, kUtime, std::string(100, static_cast<char>(i)));
    if (i % 3 == 2) writer.write(McapWriter::Metadata{"end", {}});
  }
  writer.close();
  return bytes_of(test::contents(folder / "a.mcap"));
}

/// Reads all messages. What the reader returns must be memory that exists, and not too much.
std::string_view read_all(BagReader& reader) {
  std::size_t messages = 0;
  std::size_t total = 0;
  unsigned sum = 0;
  while (const auto message = reader.next()) {
    if (message->topic >= reader.topics().size()) {
      std::cerr << "a message of no topic\n";
      std::abort();
    }
    for (const std::uint8_t byte : message->data) sum += byte;
    total += message->data.size();
    ++messages;
  }
  if (total > kContentMax || sum > 255 * kContentMax) {
    std::cerr << "more messages than there are\n";
    std::abort();
  }
  if (messages == 0) return "no message";
  return texts_of(reader.damage()).empty() ? "" : "damaged";
}

template <class Reader>
std::string_view take_bag(std::span<const std::uint8_t> bytes) {
  std::unique_ptr<Reader> reader;
  try {
    reader = std::make_unique<Reader>(bytes);
  } catch (const std::runtime_error&) {
    return "no bag";
  }
  return read_all(*reader);
}

/// Every decoder on the same bytes. Values must be those of a message.
std::string_view take_message(std::span<const std::uint8_t> bytes) {
  bool accepted = false;
  for (const char* const encoding : {"cdr", "ros1"}) {
    const RosMessage message{bytes, encoding};
    for (const auto& scan : {ros_laser_scan(message), ros_multi_echo_laser_scan(message)}) {
      accepted = accepted || scan;
      if (scan) level_scan(*scan, scan->angle_min_rad > 0.0);
    }
    const auto cloud = ros_point_cloud(message);
    if (cloud) level_scan(cloud->points);
    const auto odometry = ros_odometry(message);
    const auto transforms = ros_transforms(message);
    if (odometry && !odometry->T_frame_child.matrix().allFinite()) {
      std::cerr << "odometry without a pose\n";
      std::abort();
    }
    accepted = accepted || cloud || odometry || transforms || ros_imu(message);
  }
  return accepted ? "" : "no message";
}

std::vector<Bytes> sample_messages() {
  const LaserScan scan{kUtime, std::vector<float>(30, 2.0F), -1.0, 0.05};
  Cloud cloud;
  cloud.utime = kUtime;
  cloud.lines.push_back({kUtime, {0.0F, 0.0F, 0.0F}, {{1.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F}}, {}});
  const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  return {
      bytes_of(ros2::laser_scan(scan, {}, "laser")),
      bytes_of(ros2::point_cloud(cloud, "odom")),
      bytes_of(ros2::odometry(to_message(WheelOdometry{kUtime, {1.0, 2.0, 0.5}}), "odom", "base")),
      bytes_of(ros2::imu(to_message(ImuReading{kUtime}), "imu")),
      bytes_of(ros2::transforms({{kUtime, "odom", "base", T}, {kUtime, "base", "laser", T}})),
      bytes_of(test::ros1_laser_scan(kUtime, "laser", std::vector<float>(30, 2.0F)))};
}

}  // namespace

std::vector<Target> bag_targets() {
  return {{"ROS 1 bag",
           {sample_ros1("none"), sample_ros1("lz4"), sample_ros1("bz2")},
           take_bag<Ros1BagReader>},
          {"MCAP", {sample_mcap()}, take_bag<McapReader>},
          {"ROS messages", sample_messages(), take_message}};
}

}  // namespace adit::fuzz
