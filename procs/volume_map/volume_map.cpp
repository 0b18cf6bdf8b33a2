// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "procs/volume_map/resampling.hpp"

namespace adit {
namespace {

constexpr double kSameWayRad = 0.5;  // between the headings of two scans that see much the same

/// Where a scan looks from, and which way: its lasers sit at the ends of the body and look away.
Pose2 look(const Cloud& cloud) {
  Eigen::Vector2f ahead(0.0F, 0.0F);
  for (const CloudLine& line : cloud.lines) ahead += line.origin.head<2>();
  return {0.0, 0.0, std::atan2(double{ahead.y()}, double{ahead.x()})};
}

bool has_pose(const MapGraph& graph, int local_map) {
  return local_map >= 0 && static_cast<std::size_t>(local_map) < graph.poses.size();
}

const Pose2& pose(const MapGraph& graph, int local_map) {
  return graph.poses[static_cast<std::size_t>(local_map)];
}

}  // namespace

StoredVolume stored(const PlacedVolume& placed) {
  const SubVolume& volume = placed.volume;
  return {{volume.cell_m(), volume.utime(), volume.scans(), volume.octree(), volume.points(),
           volume.refused_points()},
          placed.T_odom_volume,
          placed.tie};
}

void VolumeMap::restore(StoredVolumes stored) {
  taken_utime_ = std::move(stored.taken_utime);
  for (StoredVolume& volume : stored.volumes) {
    if (volume.contents.cell_m != params_.cell_m) {
      throw std::runtime_error("the volume that is to be continued has cells of " +
                               std::to_string(volume.contents.cell_m) + " m, not of " +
                               std::to_string(params_.cell_m) + " m");
    }
    volumes_.push_back({SubVolume(params_, std::move(volume.contents)), volume.T_odom_volume,
                        volume.tie, volume.T_odom_volume, false});
  }
  restored_ = volumes_.size();
  newest_ = volumes_.empty() ? 0 : volumes_.size() - 1;
}

bool VolumeMap::has(std::int64_t utime) const {
  return std::ranges::find(taken_utime_, utime) != taken_utime_.end();
}

bool VolumeMap::add(const Cloud& cloud) {
  taken_utime_.push_back(cloud.utime);
  const bool late = cloud.utime < session_begin_utime_;
  const std::optional<Odom>& odom = late ? odom_before_ : odom_;
  if (late && !odom) {
    ++left_out_;
    return false;
  }
  if (!newest_takes(cloud, odom)) begin_volume(cloud, odom);
  PlacedVolume& newest = volumes_[newest_];
  newest.volume.insert(cloud, between(newest.T_odom_volume, cloud.T_odom_level));
  return true;
}

bool VolumeMap::newest_takes(const Cloud& cloud, const std::optional<Odom>& odom) const {
  if (volumes_.empty() || !volumes_[newest_].volume.is_open()) return false;
  const PlacedVolume& newest = volumes_[newest_];
  if (newest.tie.has_value() != odom.has_value()) return false;
  if (odom && newest.tie->local_map != odom->local_map) return false;
  const Pose2 T_volume_level = between(newest.T_odom_volume, cloud.T_odom_level);
  return T_volume_level.translation().norm() <= params_.span_m;
}

void VolumeMap::begin_volume(const Cloud& cloud, const std::optional<Odom>& odom) {
  if (!volumes_.empty()) volumes_[newest_].volume.close();
  PlacedVolume begun{SubVolume(params_), cloud.T_odom_level, {}, cloud.T_odom_level, false};
  begun.T_volume_place = look(cloud);
  if (odom) tie(begun, *odom);
  if (const auto older = odom ? renewed_by(cloud, *odom) : std::nullopt) {
    newest_ = *older;
    const PlacedVolume& before = volumes_[newest_];
    begun.volume = SubVolume(params_, before.volume.scans());
    begun.renewals = before.renewals + 1;
    begun.T_volume_place = between(begun.T_map_volume, before.T_map_volume * before.T_volume_place);
    volumes_[newest_] = std::move(begun);
  } else {
    newest_ = volumes_.size();
    volumes_.push_back(std::move(begun));
  }
}

/// The nearest of those whose place is near enough and that look the same way. Places stay apart by
/// as much, so that there are no more than fit into the mine.
std::optional<std::size_t> VolumeMap::renewed_by(const Cloud& cloud, const Odom& odom) const {
  if (params_.renew_m <= 0.0 || !has_pose(graph_, odom.local_map)) return std::nullopt;
  const Pose2 T_map_look =
      pose(graph_, odom.local_map) * odom.T_local_odom * cloud.T_odom_level * look(cloud);
  std::optional<std::size_t> best;
  double nearest = params_.renew_m;
  for (std::size_t i = 0; i < volumes_.size(); ++i) {
    const Pose2 T_map_place = volumes_[i].T_map_volume * volumes_[i].T_volume_place;
    const Pose2 apart = between(T_map_place, T_map_look);
    const bool placed = volumes_[i].tie && !volumes_[i].left_out;
    if (!placed || std::abs(apart.theta) > kSameWayRad) continue;
    if (apart.translation().norm() > nearest) continue;
    nearest = apart.translation().norm();
    best = i;
  }
  return best;
}

void VolumeMap::set_graph(const MapGraph& graph) {
  graph_ = graph;
  graph_.constraints.clear();
  for (PlacedVolume& placed : volumes_) {
    if (!placed.tie || !has_pose(graph_, placed.tie->local_map)) continue;
    placed.T_map_volume = pose(graph_, placed.tie->local_map) * placed.tie->T_local_volume;
  }
  connect();
}

void VolumeMap::set_correction(const MapCorrection& correction) {
  correction_ = correction;
  connect();
}

/// Where odom is in the newest local map does not depend on the graph, but takes both to find.
void VolumeMap::connect() {
  if (!correction_ || correction_->revision != graph_.revision) return;
  if (!has_pose(graph_, correction_->local_map)) return;
  const Pose2& T_map_local = pose(graph_, correction_->local_map);
  if (odom_ && odom_->session != correction_->session) {
    odom_before_ = odom_;
    session_begin_utime_ = correction_->utime;
  }
  odom_ = {correction_->session, correction_->local_map,
           between(T_map_local, correction_->T_map_odom)};
  leave_out_what_is_of_another_odom();
  for (PlacedVolume& placed : volumes_) {
    if (!placed.tie && !placed.left_out) tie(placed, *odom_);
  }
}

/// What was kept without a tie was seen before the first local map of all: in the first session.
void VolumeMap::leave_out_what_is_of_another_odom() {
  if (restored_ == 0) return;
  const auto end = volumes_.begin() + static_cast<std::ptrdiff_t>(std::exchange(restored_, 0));
  if (odom_->session == 0) return;
  for (auto placed = volumes_.begin(); placed != end; ++placed) {
    if (placed->tie) continue;
    left_out_ += placed->volume.scans();
    placed->left_out = true;
  }
}

void VolumeMap::tie(PlacedVolume& placed, const Odom& odom) const {
  placed.tie = {odom.local_map, odom.T_local_odom * placed.T_odom_volume};
  if (!has_pose(graph_, odom.local_map)) return;
  placed.T_map_volume = pose(graph_, odom.local_map) * placed.tie->T_local_volume;
}

std::int64_t VolumeMap::refused_points() const {
  std::int64_t n = 0;
  for (const PlacedVolume& placed : volumes_) n += placed.volume.refused_points();
  return n;
}

OccupancyTree VolumeMap::merged() const {
  CellSet free;
  CellSet occupied;
  for (const PlacedVolume& placed : volumes_) {
    if (placed.left_out) continue;
    resample(placed.volume, placed.T_map_volume, free, occupied);
  }
  OccupancyTree tree(params_.cell_m);
  tree.update(runs_of(free, occupied));
  return tree;
}

}  // namespace adit
