// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/robot_layer.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sensing.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kPosePeriodUs = 40'000;
constexpr std::int64_t kScanPeriodUs = 100'000;
constexpr std::size_t kConfigsQueued = 50;  // of all stages at their start

}  // namespace

RobotLayer::RobotLayer(Bus& bus, TopicBoard& board, const MapFrame& frame, const Lasers& lasers)
    : board_(board), frame_(frame), lasers_(lasers) {
  tf_topic_ =
      board.add(protobuf_topic("/tf", *foxglove::FrameTransforms::descriptor(), kPosePeriodUs),
                [this] { return transforms(); });
  pose_topic_ =
      board.add(protobuf_topic("/pose", *foxglove::PoseInFrame::descriptor(), kPosePeriodUs),
                [this] { return pose_message(); });
  add_laser(bus, board, LaserId::kFront, front_);
  add_laser(bus, board, LaserId::kRear, rear_);
  subscribe<pose_t>(bus, channels::kPose, Delivery::latest(), [this](const StampedPose& pose) {
    pose_ = pose;
    board_.set_changed(tf_topic_, pose.utime);
    board_.set_changed(pose_topic_, pose.utime);
  });
  subscribe<config_t>(bus, channels::kConfig, Delivery::queued(kConfigsQueued),
                      [this](const ConfigSnapshot& config) { on_config(config); });
}

void RobotLayer::add_laser(Bus& bus, TopicBoard& board, LaserId id, Laser& laser) {
  const bool front = id == LaserId::kFront;
  laser.topic = board.add(protobuf_topic(front ? "/laser/front" : "/laser/rear",
                                         *foxglove::LaserScan::descriptor(), kScanPeriodUs),
                          [this, &laser] { return scan_message(laser); });
  const auto on_scan = [this, &laser](const LaserScan& scan) {
    laser.scan = scan;
    board_.set_changed(laser.topic, scan.utime);
  };
  const auto on_tilt = [&laser](const TiltReading& tilt) { laser.tilt_rad = tilt.angle_rad; };
  const Delivery latest = Delivery::latest();
  if (front) {
    subscribe<planar_lidar_t>(bus, channels::kLaserFront, latest, on_scan);
    subscribe<tilt_t>(bus, channels::kTiltFront, latest, on_tilt);
  } else {
    subscribe<planar_lidar_t>(bus, channels::kLaserRear, latest, on_scan);
    subscribe<tilt_t>(bus, channels::kTiltRear, latest, on_tilt);
  }
}

void RobotLayer::on_config(const ConfigSnapshot& config) {
  if (lasers_known_) return;
  std::vector<std::string> unreadable;  // the defaults remain
  const auto lasers = recorded_section<Lasers>(config, Lasers::kSection, unreadable);
  if (!lasers) return;
  lasers_ = *lasers;
  lasers_known_ = true;
}

Eigen::Isometry3d RobotLayer::T_odom_body() const {
  return in_space(pose_->T_odom_body, pose_->z_m, pose_->attitude);
}

std::string RobotLayer::transforms() const {
  if (!pose_) return {};
  const std::int64_t utime = pose_->utime;
  const LevelPose& T_map_odom = frame_.T_map_odom();
  foxglove::FrameTransforms message;
  values::add_transform(message, utime, "map", "odom", in_space(T_map_odom.plan, T_map_odom.z_m));
  values::add_transform(message, utime, "odom", "body", T_odom_body());
  values::add_transform(message, utime, "body", front_.frame,
                        tilted_laser(lasers_.front, front_.tilt_rad));
  values::add_transform(message, utime, "body", rear_.frame,
                        tilted_laser(lasers_.rear, rear_.tilt_rad));
  return message.SerializeAsString();
}

std::string RobotLayer::pose_message() const {
  if (!pose_) return {};
  const LevelPose& T_map_odom = frame_.T_map_odom();
  foxglove::PoseInFrame message;
  values::set_time(*message.mutable_timestamp(), pose_->utime);
  message.set_frame_id("map");
  values::set_pose(*message.mutable_pose(),
                   in_space(T_map_odom.plan, T_map_odom.z_m) * T_odom_body());
  return message.SerializeAsString();
}

std::string RobotLayer::scan_message(const Laser& laser) const {
  if (laser.scan.ranges_m.empty()) return {};
  const LaserMount& mount = &laser == &front_ ? lasers_.front : lasers_.rear;
  foxglove::LaserScan message;
  values::set_time(*message.mutable_timestamp(), laser.scan.utime);
  message.set_frame_id(laser.frame);
  values::set_pose(*message.mutable_pose(), LevelPose{});
  message.set_start_angle(laser.scan.angle_min_rad);
  message.set_end_angle(laser.scan.angle_min_rad +
                        static_cast<double>(laser.scan.ranges_m.size() - 1) *
                            laser.scan.angle_step_rad);
  for (const double range : laser.scan.ranges_m) {
    const bool returned = range >= mount.range_min_m && range < mount.range_max_m;  // not NaN
    message.add_ranges(returned ? range : 0.0);
  }
  return message.SerializeAsString();
}

}  // namespace adit
