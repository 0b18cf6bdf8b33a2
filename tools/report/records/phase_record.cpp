// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/phase_record.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 100;

bool is_same_interval(const MissionPhase& a, const MissionPhase& b) {
  return a.sequence == b.sequence && a.phase == b.phase && a.utime == b.utime;
}

}  // namespace

PhaseRecord::PhaseRecord(Bus& bus) {
  subscribe<phase_t>(bus, channels::kPhase, Delivery::queued(kQueued),
                     [this](const MissionPhase& phase) { on_phase(phase); });
  subscribe<vehicle_state_t>(bus, channels::kVehicleState, Delivery::queued(kQueued),
                             [this](const VehicleState& state) { budget_.add(state); });
  subscribe<pose_t>(
      bus, channels::kPose, Delivery::queued(kQueued),
      [this](const StampedPose& pose) { budget_.add(pose.utime, pose.T_odom_body, pose.z_m); });
  subscribe<scan_request_t>(
      bus, channels::kScanRequest, Delivery::queued(kQueued),
      [this](const ScanRequest& request) { infer(request.utime, Phase::kScan); });
  subscribe<cloud_t>(
      bus, channels::kCloud, Delivery::queued(kQueued),
      [this](const CloudFragment& fragment) { infer(fragment.part.utime, Phase::kWaiting); });
  subscribe<driving_state_t>(
      bus, channels::kDrivingState, Delivery::queued(kQueued), [this](const DrivingState& state) {
        const bool is_driving = state.kind == DrivingState::Kind::kDriving;
        const bool was_driving =
            !inferred_.empty() && inferred_.back().phase.phase == Phase::kExecute;
        if (is_driving != was_driving)
          infer(state.utime, is_driving ? Phase::kExecute : Phase::kWaiting);
      });
}

void PhaseRecord::on_phase(const MissionPhase& phase) {
  budget_.add(phase);
  if (reported_.empty() || !is_same_interval(reported_.back().phase, phase)) {
    if (!reported_.empty()) {
      reported_.back().to_utime = std::max(phase.utime, reported_.back().phase.utime);
    }
    reported_.push_back({phase, phase.utime, phase.distance_travelled_m});
  }
  reported_.back().end_distance_travelled_m = phase.distance_travelled_m;
  if (reported_.size() > 1) {
    auto& previous = reported_[reported_.size() - 2];
    previous.end_distance_travelled_m =
        std::max(previous.end_distance_travelled_m, reported_.back().phase.distance_travelled_m);
  }
  if (phase.returning_home && !return_home_utime_) return_home_utime_ = phase.utime;
  last_ = phase;
}

void PhaseRecord::infer(std::int64_t utime, Phase phase) {
  if (!inferred_.empty() && inferred_.back().phase.phase == phase) return;
  if (!inferred_.empty()) {
    utime = std::max(utime, inferred_.back().phase.utime);
    inferred_.back().to_utime = utime;
  }
  MissionPhase start;
  start.utime = utime;
  start.phase = phase;
  inferred_.push_back({start, utime, 0.0});
}

void PhaseRecord::finish(std::int64_t end_utime) {
  for (auto* intervals : {&reported_, &inferred_}) {
    if (intervals->empty()) continue;
    PhaseInterval& last = intervals->back();
    last.to_utime = std::max(last.phase.utime, end_utime);
  }
}

}  // namespace adit
