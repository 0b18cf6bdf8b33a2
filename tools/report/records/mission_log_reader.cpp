// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/mission_log_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "tools/report/records/play_logs.hpp"

namespace adit {
namespace {

/// All channels that somebody reads. With `remap` those of mapping come from the stage.
ChannelSet selected_channels(const StageBus& bus, bool remap) {
  ChannelSet selected;
  for (const SubscriptionId id : bus.subscriptions()) selected.emplace(bus.stats(id).channel);
  if (!remap) return selected;
  for (const auto channel : {channels::kLocalMap, channels::kPoseGraph, channels::kMapCorrection,
                             channels::kAssociation, channels::kContradictions}) {
    selected.erase(std::string(channel));
  }
  return selected;
}

/// Recorded parameters of a stage, without its journal.
template <class Params>
Params stage_params(const LogInfo& log_info, const std::string& stage,
                    std::vector<std::string>& warnings) {
  auto params = recorded_params<Params>(log_info, stage, warnings);
  if constexpr (requires { params.lasers; }) params.lasers = log_info.lasers;
  params.journal.clear();
  return params;
}

}  // namespace

MissionLogReader::MissionLogReader(const LogInfo& log_info, bool remap,
                                   std::optional<std::string> viewer_page)
    : log_info_(log_info),
      scan_renderer_(recorded_params<PlanningParams>(log_info, "planning", config_warnings_)),
      scans_(stage_bus_, [this](const ScanProducts& scan) { return scan_renderer_.render(scan); }),
      volume_(stage_bus_,
              stage_params<VolumeMapNode::Params>(log_info, "volume_map", config_warnings_)) {
  if (viewer_page) page_.emplace(stage_bus_, log_info.lasers, std::move(*viewer_page));
  if (!remap) return;
  mapping_.emplace(stage_bus_,
                   stage_params<MappingNodeParams>(log_info, "mapping", config_warnings_));
}

void MissionLogReader::read(const ReportOptions& options,
                            const std::function<void(double)>& progress) {
  play_logs(options.logs, selected_channels(stage_bus_, options.remap), bus_, progress, [this] {
    if (page_) page_->record(bus_.now_utime());
  });
  phases_.finish(log_info_.last_utime);
  scans_.finish();
  events_.finish(log_info_.last_utime);
}

std::vector<std::string> MissionLogReader::warnings() const {
  std::map<std::string, std::int64_t> rejected;  // by channel, which may have several subscribers
  for (const SubscriptionId id : stage_bus_.subscriptions()) {
    const SubscriptionStats& stats = stage_bus_.stats(id);
    rejected[stats.channel] = std::max(rejected[stats.channel], stats.rejected);
  }
  std::vector<std::string> warnings = config_warnings_;
  for (const auto& [channel, count] : rejected) {
    if (count == 0) continue;
    warnings.push_back(fmt::format(
        "skipped {} messages of {} that are damaged or of another version", count, channel));
  }
  return warnings;
}

}  // namespace adit
