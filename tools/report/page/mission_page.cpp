// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/mission_page.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "tools/report/page/blockages.hpp"
#include "tools/report/page/mission_html.hpp"
#include "tools/report/page/mission_summary.hpp"
#include "tools/report/page/scan_cards.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::size_t kMegabyte = 1'000'000;
constexpr std::int64_t kStepUs = kSecondUs / 10;

constexpr const char* kScans = "/scans";
/// Of points in /volume, which are the largest part of the page and hardly compressible.
constexpr int kVolumePointsMax = 300'000;

/// What the page keeps of a topic. Transforms and laser scans have intervals of which one divides
/// the other, so that each scan has a transform of its time. Of the clouds the last are enough: the
/// points of the volume name their scan, and so their time. The history has the poses.
TopicRecorder::Limits limits_of(const Topic& topic) {
  static const std::map<std::string_view, TopicRecorder::Limits> kLimits{
      {"/tf", {kSecondUs, 2 * kMegabyte}},
      {"/pose", {TopicRecorder::kAtEnd, kMegabyte}},
      {"/laser/front", {4 * kSecondUs, kMegabyte}},
      {"/laser/rear", {4 * kSecondUs, kMegabyte}},
      {"/map", {30 * kSecondUs, 48 * kMegabyte}},
      {"/cloud", {TopicRecorder::kAtEnd, kMegabyte}},
      {"/volume", {TopicRecorder::kAtEnd, kMegabyte}},
      {"/trajectory", {120 * kSecondUs, kMegabyte}},
      {"/path", {2 * kSecondUs, 2 * kMegabyte}},
      {"/uncertainty", {60 * kSecondUs, kMegabyte}},
      {"/graph", {60 * kSecondUs, 6 * kMegabyte}},
      {"/mission", {2 * kSecondUs, 4 * kMegabyte}}};
  constexpr TopicRecorder::Limits kOther{10 * kSecondUs, 3 * kMegabyte};
  const auto limits = kLimits.find(topic.name);
  return limits == kLimits.end() ? kOther : limits->second;
}

SceneParameters scene_parameters(const Lasers& lasers) {
  SceneParameters parameters;
  parameters.lasers = lasers;
  parameters.volume_points_max = kVolumePointsMax;
  return parameters;
}

}  // namespace

MissionPage::MissionPage(Bus& bus, const Lasers& lasers, std::string page)
    : page_(std::move(page)),
      scene_(bus, board_, scene_parameters(lasers)),
      summary_(board_.add(json_topic("/summary", "adit.Summary"))) {
  recorder_.begin(limits_of);
}

void MissionPage::record(std::int64_t utime) {
  if (utime < recorded_utime_ + kStepUs) return;
  recorded_utime_ = utime;
  recorder_.record(utime);
}

std::string MissionPage::html(const MissionRecords& records, const MissionStatistics& statistics,
                              const MissionMap& map, const OccupancyGrid* grid,
                              const std::string& title, const std::vector<std::string>& warnings) {
  const auto& exploration = records.state.exploration();
  const std::vector<Blockage> places =
      exploration ? blockages(exploration->frontiers, map.path(), grid) : std::vector<Blockage>{};
  board_.append(summary_, statistics.to_utime,
                summary_message(records, statistics, places, warnings));
  recorder_.finish(statistics.to_utime);

  // The scans of the records replace those of the scene: these have pictures.
  const std::vector<Topic>& topics = board_.topics();
  const auto scans = std::find_if(topics.begin(), topics.end(),
                                  [](const Topic& topic) { return topic.name == kScans; });
  std::vector<TopicRecorder::Record> messages = recorder_.records();
  if (scans != topics.end()) {
    const auto id = static_cast<TopicId>(std::distance(topics.begin(), scans));
    std::erase_if(messages, [&](const auto& message) { return message.topic == id; });
    for (const RecordedScan& scan : records.scans.scans()) {
      auto bytes = std::make_shared<const std::string>(scan_message(scan, map));
      messages.push_back({id, {scan.utime, std::move(bytes)}});
    }
  }
  return mission_html(page_, title, topics, messages);
}

}  // namespace adit
