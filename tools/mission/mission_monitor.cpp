// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/bus/channels.hpp"
#include "common/bus/log/recording.hpp"
#include "common/bus/node/stages.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sim.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;

}  // namespace

MissionMonitor::MissionMonitor(Bus& bus, const std::filesystem::path& trace,
                               const MissionStart& start)
    : start_(start), follower_(bus, trace, [this] { return simulated_s(); }) {
  for (const std::string& stage : stage_names()) {
    if (stage != "supervisor") responses_[stage];
  }
  subscribe_all(bus);
}

void MissionMonitor::subscribe_all(Bus& bus) {
  const auto all = Delivery::queued(kQueued);
  subscribe<sim_time_t>(bus, channels::kSimTime, all, [this](const SimTime& time) {
    if (first_utime_ == 0) first_utime_ = time.utime;
    utime_ = std::max(utime_, time.utime);
  });
  subscribe<sim_time_done_t>(bus, channels::kSimTimeDone, all, [this](const SimTimeDone& done) {
    const auto found = responses_.find(done.stage);
    if (found != responses_.end()) found->second = {done.utime, std::nullopt, false};
  });
  subscribe<pose_t>(bus, channels::kTruth, Delivery::latest(), [this](const StampedPose& truth) {
    const Eigen::Vector2d off = truth.T_odom_body.translation() - start_.p_world;  // T_world_body
    if (!start_.z_m) start_.z_m = truth.z_m;
    follower_.set_distance_from_start(std::hypot(off.x(), off.y(), truth.z_m - *start_.z_m));
  });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, all, [this](const Heartbeat& heartbeat) {
    const Health& health = heartbeat.health;
    if (heartbeat.stage == Recording::kStage) follower_.add_not_stored(health.reason);
    if (health.level == Health::Level::kFault && is_about_journal(health.reason))
      follower_.add_not_stored(heartbeat.stage + ": " + health.reason);
  });
  subscribe<cloud_t>(bus, channels::kCloud, all, [this](const CloudFragment& fragment) {
    if (fragment.fragment == 0) scans_to_store_.insert(fragment.part.utime);
  });
  // Terrain requests scans, too, and reports none as received.
  subscribe<cloud_request_t>(bus, channels::kCloudRequest, all,
                             [this](const CloudRequest& request) {
                               for (const std::int64_t utime : request.received_utime)
                                 scans_to_store_.erase(utime);
                             });
  subscribe<run_state_t>(bus, channels::kRunState, Delivery::latest(),
                         [this](const RunState& state) { failure_ = state.failure; });
}

bool MissionMonitor::has_ended() const {
  return follower_.has_ended() && (scans_to_store_.empty() || follower_.has_ended(kStoringMaxS));
}

double MissionMonitor::simulated_s() const { return seconds(utime_ - first_utime_); }

std::vector<std::string> MissionMonitor::newly_timed_out(std::int64_t wall_us) {
  std::vector<std::string> timed_out;
  for (auto& [stage, response] : responses_) {
    if (utime_ == 0 || response.utime >= utime_) continue;
    if (!response.behind_since_us) response.behind_since_us = wall_us;
    if (response.reported || wall_us - *response.behind_since_us < kStageTimeoutUs) continue;
    response.reported = true;
    timed_out.push_back(stage);
  }
  return timed_out;
}

}  // namespace adit
