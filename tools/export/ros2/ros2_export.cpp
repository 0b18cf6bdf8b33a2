// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/export/ros2/ros2_export.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/files/file_utils.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tools/export/replay_logs.hpp"
#include "tools/export/ros2/occupancy_topic.hpp"
#include "tools/export/ros2/ros2_messages.hpp"
#include "tools/export/ros2/rosbag2_writer.hpp"
#include "tools/map/result_folder.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMap = "map";
constexpr const char* kOdom = "odom";
constexpr const char* kBody = "base_link";

std::string frame_of(LaserId laser) {
  return laser == LaserId::kFront ? "laser_front" : "laser_rear";
}

/// What a first pass over the logs finds.
struct LogContents {
  std::set<std::string, std::less<>> channels;
  std::optional<Lasers> lasers;
  std::vector<std::string> warnings;

  void add(const LogEventView& event) {
    if (!channels.contains(event.channel)) channels.emplace(event.channel);
    if (lasers || event.channel != channels::kConfig) return;
    const auto message = decode<config_t>(event.data);
    if (!message) return;
    const auto snapshot = from_message(*message);
    if (snapshot) lasers = recorded_section<Lasers>(*snapshot, Lasers::kSection, warnings);
  }
};

/// The messages of logs as those of ROS 2.
class Ros2Recorder {
 public:
  Ros2Recorder(Rosbag2Writer& bag, const LogContents& contents, const SceneParameters& parameters)
      : bag_(bag),
        lasers_(contents.lasers.value_or(Lasers{})),
        map_(parameters),
        converters_{{channels::kLaserFront, converter(&Ros2Recorder::add_front)},
                    {channels::kLaserRear, converter(&Ros2Recorder::add_rear)},
                    {channels::kTiltFront, converter(&Ros2Recorder::add_front_tilt)},
                    {channels::kTiltRear, converter(&Ros2Recorder::add_rear_tilt)},
                    {channels::kWheelOdometry, converter(&Ros2Recorder::add_wheels)},
                    {channels::kImu, converter(&Ros2Recorder::add_imu)},
                    {channels::kPose, converter(&Ros2Recorder::add_pose)},
                    {channels::kMapCorrection, converter(&Ros2Recorder::add_correction)},
                    {channels::kCloud, converter(&Ros2Recorder::add_cloud)},
                    {channels::kPath, converter(&Ros2Recorder::add_path)}} {
    fixed_[LaserId::kFront] = contents.channels.contains(channels::kLaserFront) &&
                              !contents.channels.contains(channels::kTiltFront);
    fixed_[LaserId::kRear] = contents.channels.contains(channels::kLaserRear) &&
                             !contents.channels.contains(channels::kTiltRear);
    has_pose_ = contents.channels.contains(channels::kPose);
  }

  /// Events in order of time; one with a damaged time is skipped.
  void play(const LogEventView& event) {
    if (!is_playable_after(event.utime, utime_)) {
      ++skipped_;
      return;
    }
    if (utime_ == 0) begin(event.utime);
    utime_ = event.utime;
    const auto converter = converters_.find(event.channel);
    if (converter != converters_.end() && !converter->second(event.data)) ++rejected_;
    if (const auto map = map_.play(event)) add(*map);
  }

  void finish(std::vector<std::string>& warnings) {
    if (const auto map = map_.last()) add(*map);
    if (skipped_ > 0)
      warnings.push_back(fmt::format("skipped {} events with implausible times", skipped_));
    if (rejected_ > 0) warnings.push_back(fmt::format("skipped {} invalid messages", rejected_));
  }

 private:
  /// Whether the bytes are a valid message.
  using Converter = std::function<bool(std::span<const std::uint8_t>)>;

  template <class Message>
  Converter converter(void (Ros2Recorder::*take)(const Message&)) {
    return [this, take](std::span<const std::uint8_t> bytes) {
      const Result<Message> message = decode<Message>(bytes);
      if (!message || !from_message(*message)) return false;
      (this->*take)(*message);
      return true;
    };
  }

  /// The frames that do not move, and the map where odom begins.
  void begin(std::int64_t utime) {
    utime_ = utime;
    std::vector<ros2::StampedTransform> fixed;
    for (const LaserId laser : {LaserId::kFront, LaserId::kRear}) {
      if (fixed_[laser])
        fixed.push_back({utime, kBody, frame_of(laser), tilted_laser(mount(laser), 0.0)});
    }
    if (!fixed.empty()) write("/tf_static", ros2::kTfMessage, utime, ros2::transforms(fixed));
    if (has_pose_) add_transform({utime, kMap, kOdom, Eigen::Isometry3d::Identity()});
  }

  void write(const char* topic, const char* type, std::int64_t utime, const std::string& bytes) {
    bag_.write(topic, type, utime_, utime, bytes);
  }

  void add_transform(const ros2::StampedTransform& transform) {
    write("/tf", ros2::kTfMessage, transform.utime, ros2::transforms({transform}));
  }

  [[nodiscard]] const LaserMount& mount(LaserId laser) const {
    return laser == LaserId::kFront ? lasers_.front : lasers_.rear;
  }

  void add_scan(LaserId laser, const planar_lidar_t& message) {
    const auto scan = from_message(message);
    write(laser == LaserId::kFront ? "/scan_front" : "/scan_rear", ros2::kLaserScan, scan->utime,
          ros2::laser_scan(*scan, mount(laser), frame_of(laser)));
  }
  void add_front(const planar_lidar_t& message) { add_scan(LaserId::kFront, message); }
  void add_rear(const planar_lidar_t& message) { add_scan(LaserId::kRear, message); }

  void add_tilt(LaserId laser, const tilt_t& tilt) {
    add_transform({tilt.utime, kBody, frame_of(laser), tilted_laser(mount(laser), tilt.angle_rad)});
  }
  void add_front_tilt(const tilt_t& tilt) { add_tilt(LaserId::kFront, tilt); }
  void add_rear_tilt(const tilt_t& tilt) { add_tilt(LaserId::kRear, tilt); }

  void add_wheels(const wheel_odometry_t& reading) {
    write("/wheel_odometry", ros2::kOdometry, reading.utime,
          ros2::odometry(reading, "wheel", kBody));
  }

  void add_imu(const imu_t& reading) {
    write("/imu", ros2::kImu, reading.utime, ros2::imu(reading, kBody));
  }

  void add_pose(const pose_t& message) {
    const auto pose = from_message(message);
    const Eigen::Isometry3d T_odom_body = in_space(pose->T_odom_body, pose->z_m, pose->attitude);
    add_transform({pose->utime, kOdom, kBody, T_odom_body});
    write("/pose", ros2::kPoseStamped, pose->utime, ros2::pose(pose->utime, T_odom_body, kOdom));
  }

  void add_correction(const map_correction_t& message) {
    const auto correction = from_message(message);
    add_transform({correction->utime, kMap, kOdom,
                   in_space(correction->T_map_odom, correction->z_map_odom_m)});
  }

  void add_cloud(const cloud_t& message) {
    const auto cloud = clouds_.add(*from_message(message));
    if (cloud) write("/cloud", ros2::kPointCloud2, cloud->utime, ros2::point_cloud(*cloud, kOdom));
  }

  void add_path(const planned_path_t& message) {
    const auto path = from_message(message);
    write("/path", ros2::kPath, path->utime, ros2::path(*path, kOdom));
  }

  void add(const ros2::OccupancyCells& map) {
    write("/map", ros2::kOccupancyGrid, map.utime, ros2::occupancy_grid(map, kMap));
  }

  Rosbag2Writer& bag_;
  Lasers lasers_;
  OccupancyTopic map_;
  std::map<std::string_view, Converter> converters_;
  std::map<LaserId, bool> fixed_;  ///< lasers that do not tilt
  bool has_pose_ = false;
  CloudReassembler clouds_;
  std::int64_t utime_ = 0;  ///< of the recording
  std::size_t skipped_ = 0;
  std::size_t rejected_ = 0;
};

void require_empty(const fs::path& folder) {
  if (fs::exists(folder) && (!fs::is_directory(folder) || !fs::is_empty(folder)))
    throw std::runtime_error(fmt::format("{}: exists and is not empty", folder.string()));
}

}  // namespace

Ros2Export export_ros2(const std::vector<fs::path>& given, const fs::path& folder,
                       const SceneParameters& parameters,
                       const std::function<void(double)>& progress) {
  require_empty(folder);
  const std::vector<fs::path> logs = in_order_of_time(given);
  LogContents contents;
  for (const fs::path& log : logs) {
    LogReader reader(log);
    while (const auto event = reader.next()) contents.add(*event);
  }
  const std::string name = fs::absolute(folder / "").parent_path().filename().string();
  const ResultFolder results(folder);
  Rosbag2Writer bag(results.unfinished() / (name + "_0.mcap"));
  Ros2Recorder recorder(bag, contents, parameters);
  Ros2Export result;
  result.warnings = contents.warnings;
  for (std::string& warning :
       replay_logs(logs, progress, [&](const LogEventView& event) { recorder.play(event); })) {
    result.warnings.push_back(std::move(warning));
  }
  recorder.finish(result.warnings);
  if (bag.messages() == 0) {
    throw std::runtime_error(
        fmt::format("no message that ROS has a type for in {}", logs.front().string()));
  }
  bag.close();
  write_text_file(bag.metadata(), results.unfinished() / "metadata.yaml");
  results.publish();
  result.messages = bag.messages();
  result.topics = bag.topics();
  return result;
}

}  // namespace adit
