// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/scan_layer.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/json_text.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

constexpr std::size_t kPlansQueued = 50;
constexpr std::size_t kPlansMax = 50;  // of one scan

}  // namespace

ScanLayer::ScanLayer(Bus& bus, TopicBoard& board, const MapFrame& frame)
    : board_(board), frame_(frame) {
  topic_ = board.add(json_topic("/scans", "adit.Scan"));
  subscribe<scan_request_t>(bus, channels::kScanRequest, Delivery::latest(),
                            [this](const ScanRequest& request) { request_ = request; });
  subscribe<planned_path_t>(bus, channels::kPath, Delivery::queued(kPlansQueued),
                            [this](const PlannedPath& path) { on_path(path); });
}

int ScanLayer::add_cloud(const Cloud& cloud) {
  if (newest_ && newest_->utime == cloud.utime) return newest_->number;  // sent again
  newest_ = Scan{.number = ++scans_,
                 .id = cloud.id,
                 .utime = cloud.utime,
                 .laser = {},
                 .points = cloud.points(),
                 .complete = cloud.complete,
                 .T_level = frame_.anchored({cloud.T_odom_level, cloud.z_odom_m}),
                 .plans = {}};
  if (request_ && request_->id == cloud.id) newest_->laser = request_->laser;
  append(*newest_);
  return newest_->number;
}

/// A path has the time of the scan from which its terrain is made.
void ScanLayer::on_path(const PlannedPath& path) {
  if (!newest_ || newest_->utime != path.utime || newest_->plans.size() >= kPlansMax) return;
  newest_->plans.push_back(
      {path.outcome, path.reason, path.reached_m, path_length_m(path), least_clearance_m(path)});
  append(*newest_);
}

void ScanLayer::append(const Scan& scan) {
  using nlohmann::json;
  json plans = json::array();
  for (const Plan& plan : scan.plans) {
    plans.push_back(
        {{"outcome", name_of(plan.outcome)},
         {"reason", plan.reason},
         {"reached_m", plan.reached_m},
         {"length_m", plan.length_m},
         {"clearance_m", std::isfinite(plan.clearance_m) ? json(plan.clearance_m) : json()}});
  }
  const LevelPose T_map_level = frame_.T_map(scan.T_level);
  json message{{"number", scan.number},
               {"id", scan.id},
               {"time_s", seconds(scan.utime)},
               {"x", T_map_level.plan.x},
               {"y", T_map_level.plan.y},
               {"z", T_map_level.z_m},
               {"heading_rad", T_map_level.plan.theta},
               {"points", scan.points},
               {"complete", scan.complete},
               {"plans", std::move(plans)}};
  if (scan.laser) message["laser"] = laser_channel(*scan.laser);
  board_.append(topic_, scan.utime, json_text(message), fmt::format("scan {}", scan.number));
}

}  // namespace adit
