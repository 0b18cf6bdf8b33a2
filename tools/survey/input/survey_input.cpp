// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/input/survey_input.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/report/records/play_logs.hpp"
#include "tools/report/records/state_record.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;

/// Collects the 3D scans. Beams without return are of no use here and take as much memory.
class CloudRecord {
 public:
  explicit CloudRecord(Bus& bus) {
    subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kQueued),
                       [this](const CloudFragment& fragment) {
                         if (auto cloud = fragments_.add(fragment)) add(std::move(*cloud));
                       });
  }

  [[nodiscard]] std::vector<Cloud> release() { return std::move(clouds_); }

 private:
  void add(Cloud cloud) {
    for (CloudLine& line : cloud.lines) {
      line.misses.clear();
      line.misses.shrink_to_fit();
      line.points.shrink_to_fit();
    }
    clouds_.push_back(std::move(cloud));
  }

  CloudReassembler fragments_;
  std::vector<Cloud> clouds_;
};

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
                         const std::function<void(double)>& progress)
    : log_info_(read_log_info(logs)) {
  StateRecord state(bus_);
  CloudRecord clouds(bus_);
  play_logs(
      logs, channels_of(bus_), memory_,
      [&](double done) {
        if (progress) progress(done);
      },
      [] {});
  map_ = std::make_unique<MissionMap>(record_);
  clouds_ = clouds.release();
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
