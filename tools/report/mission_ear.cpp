// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_ear.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "common/bus/channels.hpp"
#include "tools/report/log_player.hpp"

namespace adit {
namespace {

using Channels = std::set<std::string, std::less<>>;

Channels wanted_channels(bool remap) {
  Channels wanted;
  for (const auto channel :
       {channels::kPhase, channels::kScanRequest, channels::kCloud, channels::kDrivingState,
        channels::kPose, channels::kTruth, channels::kTerrain, channels::kGoal, channels::kPath,
        channels::kStop, channels::kMissionOrder, channels::kHeartbeat, channels::kExploration,
        channels::kRunState, channels::kGas, channels::kVehicleState}) {
    wanted.emplace(channel);
  }
  const auto map = {channels::kLocalMap, channels::kPoseGraph, channels::kMapCorrection,
                    channels::kAssociation};
  const auto input = {channels::kLaserFront, channels::kLaserRear, channels::kScanMatch};
  for (const auto channel : remap ? input : map) wanted.emplace(channel);
  return wanted;
}

/// As the mission had it, but for its journal.
MappingNodeParams mapping_params(const LogCensus& census) {
  auto params = recorded_params<MappingNodeParams>(census, "mapping");
  params.lasers = census.lasers();
  params.journal.clear();
  return params;
}

PlanningParams planning_params(const LogCensus& census) {
  return recorded_params<PlanningParams>(census, "planning");
}

/// The journal stays where it was.
VolumeMapNode::Params volume_params(const LogCensus& census) {
  auto params = recorded_params<VolumeMapNode::Params>(census, "volume_map");
  params.journal.clear();
  return params;
}

}  // namespace

MissionEar::MissionEar(const LogCensus& census, bool remap)
    : census_(census),
      drawing_(planning_params(census)),
      scans_(heard_, [this](const ScanToDraw& scan) { return drawing_.draw(scan); }),
      volume_(heard_, volume_params(census)) {
  if (remap) mapping_.emplace(heard_, mapping_params(census));
}

void MissionEar::listen(const ReportOptions& options, const std::function<void(double)>& progress) {
  play_logs(options.logs, wanted_channels(options.remap), bus_, progress);
  phases_.finish(census_.last_utime);
  scans_.finish();
  events_.finish(census_.last_utime);
}

std::vector<std::string> MissionEar::complaints() const {
  std::map<std::string, std::int64_t> refused;  // by channel; several may hear one
  for (const SubscriptionId id : heard_.subscriptions()) {
    const SubscriptionStats& stats = heard_.stats(id);
    refused[stats.channel] = std::max(refused[stats.channel], stats.refused);
  }
  std::vector<std::string> complaints;
  for (const auto& [channel, count] : refused) {
    if (count == 0) continue;
    complaints.push_back("passed over " + std::to_string(count) + " messages of " + channel +
                         " that are damaged, or of another version");
  }
  return complaints;
}

}  // namespace adit
