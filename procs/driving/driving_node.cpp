// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/driving_node.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kPoseQueueSize = 100;  // more than a second of an LMS-200 at 75 Hz
constexpr std::int64_t kStatePeriodUs = 4 * DrivingNode::kCommandPeriodUs;

bool has_changed(const DrivingState& state, const DrivingState& published) {
  return state.kind != published.kind || state.reason != published.reason ||
         state.path_id != published.path_id || state.utime < published.utime ||
         state.utime >= published.utime + kStatePeriodUs;
}

}  // namespace

DrivingNode::DrivingNode(Bus& bus, const Params& params) : bus_(bus), driving_(params) {
  const auto measured = Delivery::queued(kPoseQueueSize);
  subscribe<pose_t>(bus, channels::kPose, measured, [this](const StampedPose& pose) {
    driving_.add_pose(pose.utime, pose.T_odom_body, pose.attitude);
  });
  subscribe<scan_match_t>(bus, channels::kScanMatch, measured,
                          [this](const ScanMatch& match) { driving_.add_match(match); });
  subscribe_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
  subscribe_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
  subscribe<vehicle_state_t>(bus, channels::kVehicleState, Delivery::latest(),
                             [this](const VehicleState& state) { driving_.add_state(state); });
  subscribe<planned_path_t>(bus, channels::kPath, Delivery::latest(),
                            [this](const PlannedPath& path) { driving_.follow(path); });
  subscribe<phase_t>(bus, channels::kPhase, Delivery::latest(), [this](const MissionPhase& phase) {
    driving_.add_phase(phase, bus_.now_utime());
  });
  bus.create_timer(kCommandPeriodUs, [this](std::int64_t utime) { drive(utime); });
}

void DrivingNode::subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilts) {
  subscribe<tilt_t>(bus_, tilts, Delivery::latest(), [this, laser](const TiltReading& reading) {
    driving_.add_tilt(laser, reading);
  });
  subscribe<planar_lidar_t>(bus_, scans, Delivery::latest(), [this, laser](const LaserScan& scan) {
    driving_.add_scan(laser, scan);
  });
}

void DrivingNode::drive(std::int64_t utime) {
  const DriveOutput output = driving_.drive(utime);
  publish(bus_, channels::kDriveCommand, to_message(output.command));
  if (!published_ || has_changed(output.state, *published_)) publish_state(output.state);
}

void DrivingNode::publish_state(const DrivingState& state) {
  publish(bus_, channels::kDrivingState, to_message(state));
  published_ = state;
}

Health DrivingNode::health() const {
  using Level = Health::Level;
  const DrivingState& state = driving_.state();
  if (state.kind == DrivingState::Kind::kWaiting) return {Level::kDegraded, state.reason};
  if (state.kind == DrivingState::Kind::kFailed) return {Level::kFault, state.reason};
  return {};
}

}  // namespace adit
