// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_watch.hpp"

#include <algorithm>

#include "common/bus/channels.hpp"
#include "common/bus/stages.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/map_correction.hpp"
#include "common/messages/mission_phase.hpp"
#include "common/messages/pose.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/sim_time.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 1000;

}  // namespace

MissionWatch::MissionWatch(Bus& bus, const std::filesystem::path& trace,
                           const Eigen::Vector2d& p_world_start)
    : p_world_start_(p_world_start), trace_(bus, trace, [this] { return simulated_s(); }) {
  for (const std::string& stage : stage_names()) {
    if (stage != "supervisor") answers_[stage];
  }
  listen(bus);
}

void MissionWatch::listen(Bus& bus) {
  const auto queued = Delivery::queued(kWaiting);
  subscribe<sim_time_t>(bus, channels::kSimTime, queued, [this](const SimTime& time) {
    if (first_utime_ == 0) first_utime_ = time.utime;
    utime_ = std::max(utime_, time.utime);
  });
  subscribe<sim_time_done_t>(bus, channels::kSimTimeDone, queued, [this](const SimTimeDone& done) {
    const auto found = answers_.find(done.stage);
    if (found != answers_.end()) found->second = {done.utime, std::nullopt, false};
  });
  subscribe<phase_t>(bus, channels::kPhase, queued, [this](const MissionPhase& phase) {
    if (phase_.phase != Phase::kEnded) ended_s_ = simulated_s();
    phase_ = phase;
  });
  subscribe<map_correction_t>(bus, channels::kMapCorrection, queued,
                              [this](const MapCorrection& correction) {
                                local_maps_ = std::max(local_maps_, correction.local_map + 1);
                              });
  subscribe<pose_t>(bus, channels::kTruth, Delivery::latest(), [this](const StampedPose& truth) {
    from_start_m_ =
        (truth.T_odom_body.translation() - p_world_start_).norm();  // of TRUTH: in world
    farthest_m_ = std::max(farthest_m_, from_start_m_);
  });
  subscribe<run_state_t>(bus, channels::kRunState, Delivery::latest(),
                         [this](const RunState& state) { failure_ = state.failure; });
}

double MissionWatch::simulated_s() const { return seconds(utime_ - first_utime_); }

MissionProgress MissionWatch::progress() const {
  return {phase_, simulated_s(), from_start_m_, local_maps_};
}

bool MissionWatch::has_ended() const {
  return phase_.phase == Phase::kEnded && simulated_s() > ended_s_ + kAfterEndS;
}

std::vector<std::string> MissionWatch::newly_silent(std::int64_t wall_us) {
  std::vector<std::string> silent;
  for (auto& [stage, answer] : answers_) {
    if (utime_ == 0 || answer.utime >= utime_) continue;
    if (!answer.behind_since_us) answer.behind_since_us = wall_us;
    if (answer.told || wall_us - *answer.behind_since_us < kStagePatienceUs) continue;
    answer.told = true;
    silent.push_back(stage);
  }
  return silent;
}

}  // namespace adit
