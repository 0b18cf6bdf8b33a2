// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map.hpp"

#include "procs/volume_map/resampling.hpp"

namespace adit {
namespace {

bool has_pose(const MapGraph& graph, int local_map) {
  return local_map >= 0 && static_cast<std::size_t>(local_map) < graph.poses.size();
}

const Pose2& pose(const MapGraph& graph, int local_map) {
  return graph.poses[static_cast<std::size_t>(local_map)];
}

}  // namespace

void VolumeMap::add(const Cloud& cloud) {
  if (!newest_takes(cloud)) begin_volume(cloud);
  PlacedVolume& newest = volumes_.back();
  newest.volume.insert(cloud, between(newest.T_odom_volume, cloud.T_odom_level));
}

bool VolumeMap::newest_takes(const Cloud& cloud) const {
  if (volumes_.empty()) return false;
  const PlacedVolume& newest = volumes_.back();
  if (newest.tie.has_value() != odom_.has_value()) return false;
  if (odom_ && newest.tie->local_map != odom_->local_map) return false;
  const Pose2 T_volume_level = between(newest.T_odom_volume, cloud.T_odom_level);
  return T_volume_level.translation().norm() <= params_.span_m;
}

void VolumeMap::begin_volume(const Cloud& cloud) {
  if (!volumes_.empty()) volumes_.back().volume.close();
  volumes_.push_back({SubVolume(params_), cloud.T_odom_level, {}, cloud.T_odom_level});
  if (odom_) tie(volumes_.back());
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
  odom_ = {correction_->local_map, between(T_map_local, correction_->T_map_odom)};
  for (PlacedVolume& placed : volumes_) {
    if (!placed.tie) tie(placed);
  }
}

void VolumeMap::tie(PlacedVolume& placed) const {
  placed.tie = {odom_->local_map, odom_->T_local_odom * placed.T_odom_volume};
  if (!has_pose(graph_, odom_->local_map)) return;
  placed.T_map_volume = pose(graph_, odom_->local_map) * placed.tie->T_local_volume;
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
    resample(placed.volume, placed.T_map_volume, free, occupied);
  }
  OccupancyTree tree(params_.cell_m);
  tree.update(runs_of(free, occupied));
  return tree;
}

}  // namespace adit
