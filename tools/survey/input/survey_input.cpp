// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/input/survey_input.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud_match.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/report/records/play_logs.hpp"
#include "tools/report/records/state_record.hpp"
#include "tools/survey/input/scan_hazard_record.hpp"

namespace adit {
namespace {

constexpr std::size_t kMatchesQueued = 1000;

/// Of the first CONFIG that has it.
template <class Section>
std::optional<Section> section_of(LogInfo& log_info) {
  for (const auto& [stage, config] : log_info.configs) {
    if (auto section = recorded_section<Section>(config, Section::kSection, log_info.warnings))
      return section;
  }
  return std::nullopt;
}

ChannelSet channels_of(const StageBus& bus) {
  ChannelSet channels;
  for (const SubscriptionId id : bus.subscriptions()) channels.emplace(bus.stats(id).channel);
  return channels;
}

}  // namespace

std::vector<std::filesystem::path> mission_logs(const std::vector<std::filesystem::path>& given) {
  std::vector<std::filesystem::path> logs;
  for (const std::filesystem::path& path : given) {
    if (!std::filesystem::is_directory(path)) {
      logs.push_back(path);
      continue;
    }
    const auto of_folder = MissionFolder(path).logs();
    if (of_folder.empty())
      throw std::runtime_error(fmt::format("{}: no log of a mission in it", path.string()));
    logs.insert(logs.end(), of_folder.begin(), of_folder.end());
  }
  return in_order_of_time(std::move(logs));
}

SurveyInput::SurveyInput(std::vector<std::filesystem::path> logs,
                         const std::function<void(double)>& progress,
                         const std::filesystem::path& scratch)
    : log_info_(read_log_info(logs)), vehicle_(section_of<Vehicle>(log_info_).value_or(Vehicle{})) {
  lasers_ = section_of<Lasers>(log_info_);
  StateRecord state(bus_);
  ScanHazardRecord scans(bus_, vehicle_, scratch);
  subscribe<cloud_match_t>(bus_, channels::kCloudMatch, Delivery::queued(kMatchesQueued),
                           [this](const CloudMatch& match) { cloud_matches_.push_back(match); });
  play_logs(
      logs, channels_of(bus_), memory_,
      [&](double done) {
        if (progress) progress(done);
      },
      [] {});
  map_ = std::make_unique<MissionMap>(record_);
  clouds_ = scans.release_clouds();
  hazards_ = scans.release_hazards();
  exploration_ = state.exploration();
  warnings_ = log_info_.warnings;
  const std::string first = logs.front().string();
  if (map_->full_map().local_maps.empty())
    throw std::runtime_error(fmt::format("{}: no map in it (LOCAL_MAP and POSE_GRAPH)", first));
  if (clouds_.empty()) throw std::runtime_error(fmt::format("{}: no 3D scan in it (CLOUD)", first));
  if (!exploration_)
    warnings_.emplace_back("no centre lines and frontiers: the log has no EXPLORATION");
  if (map_->missing_local_maps() > 0) {
    warnings_.push_back(fmt::format("{} local maps of the pose graph are missing in the log",
                                    map_->missing_local_maps()));
  }
}

}  // namespace adit
