// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/mission_log_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/checks.hpp"

namespace adit {
namespace {

/// Plays logs to a bus, one after the other, each in the order in which it was written; channels
/// that are not wanted are passed over. Nothing of a log is kept. `progress` is called with the
/// share that is done. Throws std::runtime_error where a file cannot be read.
void play_logs(const std::vector<std::filesystem::path>& logs,
               const std::set<std::string, std::less<>>& selected, MemoryBus& bus,
               const std::function<void(double)>& progress);

constexpr std::size_t kEventsPerProgress = 10'000;

/// A log that says it stopped for longer is another log: timers need not make up for that.
constexpr std::int64_t kGapMaxUs = 24LL * 3600 * 1'000'000;

bool is_plausible_at(std::int64_t utime, const MemoryBus& bus) {
  if (!is_plausible_utime(utime)) return false;
  return bus.now_utime() == 0 || utime - bus.now_utime() < kGapMaxUs;
}

void play_logs(const std::vector<std::filesystem::path>& logs,
               const std::set<std::string, std::less<>>& selected, MemoryBus& bus,
               const std::function<void(double)>& progress) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const MappedFile file(logs[i]);
    LogParser parser(file.bytes());
    std::size_t events = 0;
    while (const auto event = parser.next()) {
      if (selected.contains(event->channel) && is_plausible_at(event->utime, bus)) {
        bus.inject(event->utime, event->channel, event->data);
      }
      if (++events % kEventsPerProgress != 0) continue;
      const double share =
          static_cast<double>(parser.position()) / static_cast<double>(file.bytes().size());
      progress((static_cast<double>(i) + share) / static_cast<double>(logs.size()));
    }
  }
}

using Channels = std::set<std::string, std::less<>>;

Channels selected_channels(bool remap) {
  Channels selected;
  for (const auto channel :
       {channels::kPhase, channels::kScanRequest, channels::kCloud, channels::kDrivingState,
        channels::kPose, channels::kTruth, channels::kTerrain, channels::kGoal, channels::kPath,
        channels::kStop, channels::kMissionOrder, channels::kHeartbeat, channels::kExploration,
        channels::kRunState, channels::kGas, channels::kVehicleState}) {
    selected.emplace(channel);
  }
  const auto map = {channels::kLocalMap, channels::kPoseGraph, channels::kMapCorrection,
                    channels::kAssociation};
  const auto input = {channels::kLaserFront, channels::kLaserRear, channels::kScanMatch};
  for (const auto channel : remap ? input : map) selected.emplace(channel);
  return selected;
}

/// As the mission had it, but for its journal.
MappingNodeParams mapping_params(const LogInfo& log_info) {
  auto params = recorded_params<MappingNodeParams>(log_info, "mapping");
  params.lasers = log_info.lasers();
  params.journal.clear();
  return params;
}

PlanningParams planning_params(const LogInfo& log_info) {
  return recorded_params<PlanningParams>(log_info, "planning");
}

/// The journal stays where it was.
VolumeMapNode::Params volume_params(const LogInfo& log_info) {
  auto params = recorded_params<VolumeMapNode::Params>(log_info, "volume_map");
  params.journal.clear();
  return params;
}

}  // namespace

MissionLogReader::MissionLogReader(const LogInfo& log_info, bool remap)
    : log_info_(log_info),
      scan_renderer_(planning_params(log_info)),
      scans_(stage_bus_, [this](const ScanProducts& scan) { return scan_renderer_.render(scan); }),
      volume_(stage_bus_, volume_params(log_info)) {
  if (remap) mapping_.emplace(stage_bus_, mapping_params(log_info));
}

void MissionLogReader::read(const ReportOptions& options,
                            const std::function<void(double)>& progress) {
  play_logs(options.logs, selected_channels(options.remap), bus_, progress);
  phases_.finish(log_info_.last_utime);
  scans_.finish();
  events_.finish(log_info_.last_utime);
}

std::vector<std::string> MissionLogReader::warnings() const {
  std::map<std::string, std::int64_t> rejected;  // by channel; several may hear one
  for (const SubscriptionId id : stage_bus_.subscriptions()) {
    const SubscriptionStats& stats = stage_bus_.stats(id);
    rejected[stats.channel] = std::max(rejected[stats.channel], stats.rejected);
  }
  std::vector<std::string> warnings;
  for (const auto& [channel, count] : rejected) {
    if (count == 0) continue;
    warnings.push_back("passed over " + std::to_string(count) + " messages of " + channel +
                       " that are damaged, or of another version");
  }
  return warnings;
}

}  // namespace adit
