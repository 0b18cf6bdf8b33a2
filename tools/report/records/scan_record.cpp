// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/scan_record.hpp"

#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "tools/plan/scan_plan.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;

RecordedPlan to_recorded_plan(const PlannedPath& path, const std::optional<PlanGoal>& goal) {
  const bool is_answer = goal && goal->id == path.id;
  return {is_answer ? goal->utime : path.utime,
          path.outcome,
          path.reason,
          path.reached_m,
          path_length_m(path),
          least_clearance_m(path),
          path.blocking.size()};
}

}  // namespace

ScanRecord::ScanRecord(Bus& bus, Render render) : render_(std::move(render)) {
  const Delivery all = Delivery::queued(kQueued);
  subscribe<scan_request_t>(bus, channels::kScanRequest, all, [this](const ScanRequest& request) {
    laser_ = request.laser;
    request_id_ = request.id;
  });
  subscribe<cloud_t>(bus, channels::kCloud, all, [this](const CloudFragment& fragment) {
    if (auto cloud = cloud_fragments_.add(fragment)) on_cloud(std::move(*cloud));
  });
  subscribe<terrain_t>(bus, channels::kTerrain, all, [this](const TerrainFragment& tile) {
    if (auto terrain = terrain_tiles_.add(tile)) on_terrain(std::move(*terrain));
  });
  subscribe<plan_goal_t>(bus, channels::kGoal, all, [this](const PlanGoal& goal) { goal_ = goal; });
  subscribe<planned_path_t>(bus, channels::kPath, all,
                            [this](const PlannedPath& path) { on_path(path); });
}

void ScanRecord::on_cloud(Cloud cloud) {
  finish_scan();
  RecordedScan scan;
  scan.number = static_cast<int>(scans_.size()) + 1;
  scan.id = cloud.id;
  scan.utime = cloud.utime;
  if (request_id_ == cloud.id) scan.laser = laser_;
  scan.points = cloud.points();
  scan.complete = cloud.complete;
  scan.T_odom_level = cloud.T_odom_level;
  scans_.push_back(std::move(scan));
  current_.cloud = std::move(cloud);
}

void ScanRecord::on_terrain(TerrainMap terrain) {
  if (current_.cloud && current_.cloud->utime == terrain.utime)
    current_.terrain = std::move(terrain);
}

/// A path has the time of the scan from which its terrain is made.
void ScanRecord::on_path(const PlannedPath& path) {
  if (scans_.empty() || scans_.back().utime != path.utime) return;
  scans_.back().plans.push_back(to_recorded_plan(path, goal_));
  current_.path = path;
  current_.goal.reset();
  if (goal_ && goal_->id == path.id) current_.goal = goal_;
}

void ScanRecord::finish_scan() {
  if (current_.cloud) scans_.back().pictures = render_(current_);
  current_ = {};
}

}  // namespace adit
