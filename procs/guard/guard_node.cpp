// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/guard_node.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kImuQueueSize = 100;        // of one second
constexpr std::size_t kHeartbeatQueueSize = 100;  // of all stages, including the supervisor's
constexpr std::size_t kStopQueueSize = 50;
constexpr std::size_t kOwnStopsMax = 100;  // more than are in transit
constexpr std::string_view kSupervisor = "supervisor";

std::string counts_text(const Guard& guard) {
  std::string line;
  for (std::size_t i = 0; i < kStopKindNames.size(); ++i) {
    if (guard.counts().at(i) == 0) continue;
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", kStopKindNames.at(i),
                        guard.counts().at(i));
  }
  return line;
}

/// Obstacles and commands concern driving, not the health of the guard.
bool concerns_driver(const StopReason& reason) {
  return reason.kind == StopKind::kObstacle || reason.kind == StopKind::kCommand;
}

}  // namespace

GuardNode::GuardNode(Bus& bus, const Params& params) : bus_(bus), guard_(params) {
  subscribe_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
  subscribe_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
  subscribe_motion();
  subscribe_environment();
  subscribe_foreign_stops();
  bus.create_timer(kEvaluationPeriodUs, [this](std::int64_t) { evaluate(); });
}

void GuardNode::subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilts) {
  subscribe<tilt_t>(bus_, tilts, Delivery::latest(), [this, laser](const TiltReading& reading) {
    guard_.receive(laser, reading, bus_.now_utime());
  });
  subscribe<planar_lidar_t>(bus_, scans, Delivery::latest(), [this, laser](const LaserScan& scan) {
    guard_.receive(laser, scan, bus_.now_utime());
    evaluate();
  });
}

void GuardNode::subscribe_motion() {
  subscribe<drive_command_t>(bus_, channels::kDriveCommand, Delivery::latest(),
                             [this](const DriveCommand& command) {
                               guard_.receive(command, bus_.now_utime());
                               evaluate();
                             });
  subscribe<pose_t>(bus_, channels::kPose, Delivery::latest(), [this](const StampedPose& pose) {
    guard_.receive_pose(pose.T_odom_body, pose.utime, bus_.now_utime());
  });
  subscribe<map_correction_t>(
      bus_, channels::kMapCorrection, Delivery::latest(),
      [this](const MapCorrection& correction) { guard_.receive(correction); });
  subscribe<vehicle_state_t>(
      bus_, channels::kVehicleState, Delivery::latest(),
      [this](const VehicleState& state) { guard_.receive(state, bus_.now_utime()); });
  subscribe<imu_t>(
      bus_, channels::kImu, Delivery::queued(kImuQueueSize),
      [this](const ImuReading& reading) { guard_.receive(reading, bus_.now_utime()); });
}

void GuardNode::subscribe_environment() {
  subscribe<gas_t>(bus_, channels::kGas, Delivery::latest(), [this](const GasReading& reading) {
    guard_.receive(reading, bus_.now_utime());
  });
  subscribe<sinkage_t>(
      bus_, channels::kSinkage, Delivery::latest(),
      [this](const SinkageReading& reading) { guard_.receive(reading, bus_.now_utime()); });
  subscribe<heartbeat_t>(bus_, channels::kHeartbeat, Delivery::queued(kHeartbeatQueueSize),
                         [this](const Heartbeat& heartbeat) {
                           if (heartbeat.stage != kSupervisor) return;
                           guard_.receive_supervisor(heartbeat.utime, bus_.now_utime());
                         });
}

void GuardNode::subscribe_foreign_stops() {
  subscribe<stop_t>(
      bus_, channels::kStop, Delivery::queued(kStopQueueSize), [this](const StopOrder& order) {
        const bool is_own =
            std::find(own_utimes_.begin(), own_utimes_.end(), order.utime) != own_utimes_.end();
        if (order.stopped && !is_own) guard_.receive_stop(bus_.now_utime());
      });
}

void GuardNode::evaluate() {
  const StopOrder order = guard_.evaluate(bus_.now_utime());
  std::array<bool, kStopKindNames.size()> kinds{};
  for (const StopReason& reason : guard_.reasons()) {
    kinds.at(static_cast<std::size_t>(reason.kind)) = true;
  }
  const bool changed = order.stopped != published_stopped_ || kinds != published_kinds_;
  const std::int64_t since_us = order.utime - published_utime_.value_or(0);
  if (published_utime_ && !changed && since_us >= 0 && since_us < kRepeatPeriodUs) return;
  published_utime_ = order.utime;
  published_stopped_ = order.stopped;
  published_kinds_ = kinds;
  own_utimes_.push_back(order.utime);
  if (own_utimes_.size() > kOwnStopsMax) own_utimes_.pop_front();
  publish(bus_, channels::kStop, to_message(order));
}

Health GuardNode::health() const {
  std::string line;
  for (const StopReason& reason : guard_.reasons()) {
    if (!concerns_driver(reason)) line += (line.empty() ? "" : "; ") + reason.text;
  }
  if (line.empty()) return {};
  return {Health::Level::kDegraded, line + " (count: " + counts_text(guard_) + ")"};
}

}  // namespace adit
