// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/phase_record.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/cloud.hpp"
#include "common/messages/driving_state.hpp"
#include "common/messages/mission_phase.hpp"
#include "common/messages/scan_request.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 100;

bool is_same_stretch(const MissionPhase& a, const MissionPhase& b) {
  return a.sequence == b.sequence && a.phase == b.phase && a.utime == b.utime;
}

}  // namespace

PhaseRecord::PhaseRecord(Bus& bus) {
  subscribe<phase_t>(bus, channels::kPhase, Delivery::queued(kWaiting),
                     [this](const MissionPhase& phase) { on_phase(phase); });
  subscribe<scan_request_t>(
      bus, channels::kScanRequest, Delivery::queued(kWaiting),
      [this](const ScanRequest& request) { guess(request.utime, Phase::kScan); });
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kWaiting),
                     [this](const CloudPiece& piece) { guess(piece.part.utime, Phase::kWaiting); });
  subscribe<driving_state_t>(
      bus, channels::kDrivingState, Delivery::queued(kWaiting), [this](const DrivingState& state) {
        const bool drives = state.kind == DrivingState::Kind::kDriving;
        const bool drove = !guessed_.empty() && guessed_.back().phase.phase == Phase::kExecute;
        if (drives != drove) guess(state.utime, drives ? Phase::kExecute : Phase::kWaiting);
      });
}

void PhaseRecord::on_phase(const MissionPhase& phase) {
  if (said_.empty() || !is_same_stretch(said_.back().phase, phase)) {
    if (!said_.empty()) said_.back().to_utime = std::max(phase.utime, said_.back().phase.utime);
    said_.push_back({phase, phase.utime, phase.travelled_m});
  }
  said_.back().travelled_to_m = phase.travelled_m;
  if (said_.size() > 1 && is_same_stretch(said_.back().phase, phase)) {
    auto& before = said_[said_.size() - 2];
    before.travelled_to_m = std::max(before.travelled_to_m, said_.back().phase.travelled_m);
  }
  if (phase.homeward && !homeward_utime_) homeward_utime_ = phase.utime;
  last_ = phase;
}

void PhaseRecord::guess(std::int64_t utime, Phase phase) {
  if (!guessed_.empty() && guessed_.back().phase.phase == phase) return;
  // A drive that a scan interrupts ended with it.
  if (!guessed_.empty()) {
    utime = std::max(utime, guessed_.back().phase.utime);
    guessed_.back().to_utime = utime;
  }
  MissionPhase begun;
  begun.utime = utime;
  begun.phase = phase;
  guessed_.push_back({begun, utime, 0.0});
}

void PhaseRecord::finish(std::int64_t end_utime) {
  for (auto* stretches : {&said_, &guessed_}) {
    if (stretches->empty()) continue;
    PhaseStretch& last = stretches->back();
    last.to_utime = std::max(last.phase.utime, end_utime);
  }
}

}  // namespace adit
