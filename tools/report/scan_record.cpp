// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/scan_record.hpp"

#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/plan_goal.hpp"
#include "common/messages/planned_path.hpp"
#include "common/messages/scan_request.hpp"
#include "tools/plan/scan_plan.hpp"

namespace adit {
namespace {

constexpr std::size_t kWaiting = 1000;

RecordedPlan recorded(const PlannedPath& path, const std::optional<PlanGoal>& goal) {
  const bool answers = goal && goal->id == path.id;
  return {answers ? goal->utime : path.utime,
          path.outcome,
          path.reason,
          path.reached_m,
          path_length_m(path),
          least_clearance_m(path),
          path.blocking.size()};
}

}  // namespace

ScanRecord::ScanRecord(Bus& bus, Draw draw) : draw_(std::move(draw)) {
  const Delivery all = Delivery::queued(kWaiting);
  subscribe<scan_request_t>(bus, channels::kScanRequest, all, [this](const ScanRequest& request) {
    laser_ = request.laser;
    request_ = request.id;
  });
  subscribe<cloud_t>(bus, channels::kCloud, all, [this](const CloudPiece& piece) {
    if (auto cloud = cloud_pieces_.add(piece)) on_cloud(std::move(*cloud));
  });
  subscribe<terrain_t>(bus, channels::kTerrain, all, [this](const TerrainTile& tile) {
    if (auto terrain = terrain_tiles_.add(tile)) on_terrain(std::move(*terrain));
  });
  subscribe<plan_goal_t>(bus, channels::kGoal, all, [this](const PlanGoal& goal) { goal_ = goal; });
  subscribe<planned_path_t>(bus, channels::kPath, all,
                            [this](const PlannedPath& path) { on_path(path); });
}

void ScanRecord::on_cloud(Cloud cloud) {
  close_scan();
  RecordedScan scan;
  scan.number = static_cast<int>(scans_.size()) + 1;
  scan.id = cloud.id;
  scan.utime = cloud.utime;
  if (request_ == cloud.id) scan.laser = laser_;
  scan.points = cloud.points();
  scan.complete = cloud.complete;
  scan.T_odom_level = cloud.T_odom_level;
  scans_.push_back(std::move(scan));
  open_.cloud = std::move(cloud);
}

void ScanRecord::on_terrain(TerrainMap terrain) {
  if (open_.cloud && open_.cloud->utime == terrain.utime) open_.terrain = std::move(terrain);
}

/// A plan rests on the scan from which its terrain was made.
void ScanRecord::on_path(const PlannedPath& path) {
  if (scans_.empty() || scans_.back().utime != path.utime) return;
  scans_.back().plans.push_back(recorded(path, goal_));
  open_.path = path;
  open_.goal.reset();
  if (goal_ && goal_->id == path.id) open_.goal = goal_;
}

void ScanRecord::close_scan() {
  if (open_.cloud) scans_.back().pictures = draw_(open_);
  open_ = {};
}

}  // namespace adit
