// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard_node.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/gas_reading.hpp"
#include "common/messages/imu_reading.hpp"
#include "common/messages/laser_scan.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/sinkage_reading.hpp"
#include "common/messages/stop_order.hpp"
#include "common/messages/tilt_reading.hpp"
#include "common/messages/vehicle_state.hpp"

namespace adit {
namespace {

constexpr std::size_t kImuWaiting = 100;         // a second of them
constexpr std::size_t kHeartbeatsWaiting = 100;  // of all stages, so that the supervisor's is there
constexpr std::string_view kSupervisor = "supervisor";

std::string counts_text(const Guard& guard) {
  std::string line;
  for (std::size_t i = 0; i < kStopKindNames.size(); ++i) {
    if (guard.counts().at(i) == 0) continue;
    line += (line.empty() ? "" : ", ") + std::string(kStopKindNames.at(i)) + " " +
            std::to_string(guard.counts().at(i));
  }
  return line;
}

/// Of those that drive, and so no business of who looks after the guard.
bool is_of_driving(const StopReason& reason) {
  return reason.kind == StopKind::kObstacle || reason.kind == StopKind::kCommand;
}

}  // namespace

GuardNode::GuardNode(Bus& bus, const Params& params) : bus_(bus), guard_(params) {
  watch_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
  watch_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
  watch_motion();
  watch_surroundings();
  bus.every(kJudgeUs, [this](std::int64_t) { judge(); });
}

void GuardNode::watch_laser(LaserId laser, std::string_view scans, std::string_view tilts) {
  subscribe<tilt_t>(bus_, tilts, Delivery::latest(), [this, laser](const TiltReading& reading) {
    guard_.hear(laser, reading, bus_.now_utime());
  });
  subscribe<planar_lidar_t>(bus_, scans, Delivery::latest(), [this, laser](const LaserScan& scan) {
    guard_.hear(laser, scan, bus_.now_utime());
    judge();
  });
}

void GuardNode::watch_motion() {
  subscribe<drive_command_t>(bus_, channels::kDriveCommand, Delivery::latest(),
                             [this](const DriveCommand& command) {
                               guard_.hear(command, bus_.now_utime());
                               judge();
                             });
  subscribe<pose_t>(bus_, channels::kPose, Delivery::latest(), [this](const StampedPose& pose) {
    guard_.hear_pose(pose.T_odom_body, pose.utime, bus_.now_utime());
  });
  subscribe<vehicle_state_t>(
      bus_, channels::kVehicleState, Delivery::latest(),
      [this](const VehicleState& state) { guard_.hear(state, bus_.now_utime()); });
  subscribe<imu_t>(bus_, channels::kImu, Delivery::queued(kImuWaiting),
                   [this](const ImuReading& reading) { guard_.hear(reading, bus_.now_utime()); });
}

void GuardNode::watch_surroundings() {
  subscribe<gas_t>(bus_, channels::kGas, Delivery::latest(),
                   [this](const GasReading& reading) { guard_.hear(reading, bus_.now_utime()); });
  subscribe<sinkage_t>(
      bus_, channels::kSinkage, Delivery::latest(),
      [this](const SinkageReading& reading) { guard_.hear(reading, bus_.now_utime()); });
  subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(kHeartbeatsWaiting),
                         [this](const Heartbeat& heartbeat) {
                           if (heartbeat.stage != kSupervisor) return;
                           guard_.hear_supervisor(heartbeat.utime, bus_.now_utime());
                         });
}

void GuardNode::judge() {
  const StopOrder order = guard_.judge(bus_.now_utime());
  std::array<bool, kStopKindNames.size()> kinds{};
  for (const StopReason& reason : guard_.reasons()) {
    kinds.at(static_cast<std::size_t>(reason.kind)) = true;
  }
  const bool news = order.stopped != told_stopped_ || kinds != told_kinds_;
  const std::int64_t since_us = order.utime - told_utime_.value_or(0);
  if (told_utime_ && !news && since_us >= 0 && since_us < kRepeatUs) return;
  told_utime_ = order.utime;
  told_stopped_ = order.stopped;
  told_kinds_ = kinds;
  publish(bus_, channels::kStop, to_message(order));
}

Health GuardNode::health() const {
  std::string line;
  for (const StopReason& reason : guard_.reasons()) {
    if (!is_of_driving(reason)) line += (line.empty() ? "" : "; ") + reason.text;
  }
  if (line.empty()) return {};
  return {Health::Level::kDegraded, line + " (times so far: " + counts_text(guard_) + ")"};
}

}  // namespace adit
