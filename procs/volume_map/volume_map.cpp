// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "procs/volume_map/renewal.hpp"
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

StoredVolume stored(const PlacedVolume& placed) {
  const SubVolume& volume = placed.volume;
  return {{volume.cell_m(), volume.utime(), volume.scans(), volume.octree(), volume.points(),
           volume.refused_points()},
          placed.T_odom_volume,
          placed.tie,
          placed.T_volume_place};
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
                        volume.tie, volume.T_odom_volume, false, 0, volume.T_volume_place, true});
  }
  restored_ = volumes_.size();
  newest_ = volumes_.empty() ? 0 : volumes_.size() - 1;
  if (!stored.odom || stored.odom->begin_utime == 0) return;
  (stored.odom->end_utime == TiedOdom::kNoEnd ? odom_ : odom_before_) = stored.odom;
}

void VolumeMap::forget_points() {
  for (PlacedVolume& placed : volumes_) placed.volume.forget_points();
}

bool VolumeMap::has(std::int64_t utime) const {
  return std::ranges::find(taken_utime_, utime) != taken_utime_.end();
}

void VolumeMap::set_odom_begin(std::int64_t utime) {
  if (std::exchange(knows_odom_begin_, true)) return;
  if (odom_ && odom_->begin_utime == 0) odom_->begin_utime = utime;
  if (odom_ && utime > odom_->begin_utime) return end_odom(utime);
  if (odom_before_ && odom_before_->has(utime)) {  // it ended when this began, and not only then
    odom_before_->end_utime = utime;               // when a correction told of it
    session_begin_utime_ = utime;
  }
  session_begin_utime_ = std::max(session_begin_utime_, utime);
}

std::int64_t VolumeMap::known_from_utime() const {
  return odom_before_ ? odom_before_->begin_utime : session_begin_utime_;
}

bool VolumeMap::add(const Cloud& cloud) {
  taken_utime_.push_back(cloud.utime);
  const bool late = cloud.utime < session_begin_utime_;
  const std::optional<TiedOdom>& odom = late ? odom_before_ : odom_;
  if (late && !(odom && odom->has(cloud.utime))) {
    ++left_out_;
    return false;
  }
  if (!newest_takes(cloud, odom)) begin_volume(cloud, odom);
  PlacedVolume& newest = volumes_[newest_];
  newest.volume.insert(cloud, between(newest.T_odom_volume, cloud.T_odom_level));
  return true;
}

bool VolumeMap::newest_takes(const Cloud& cloud, const std::optional<TiedOdom>& odom) const {
  if (volumes_.empty() || !volumes_[newest_].volume.is_open()) return false;
  const PlacedVolume& newest = volumes_[newest_];
  if (newest.tie.has_value() != odom.has_value()) return false;
  if (odom && newest.tie->local_map != odom->local_map) return false;
  const Pose2 T_volume_level = between(newest.T_odom_volume, cloud.T_odom_level);
  if (params_.renew_m > 0.0) {
    return is_same_look(newest.T_volume_place, T_volume_level * look_of(cloud), params_.renew_m);
  }
  return T_volume_level.translation().norm() <= params_.span_m;
}

void VolumeMap::begin_volume(const Cloud& cloud, const std::optional<TiedOdom>& odom) {
  if (!volumes_.empty()) volumes_[newest_].volume.close();
  PlacedVolume begun{SubVolume(params_), cloud.T_odom_level, {}, cloud.T_odom_level, false};
  begun.T_volume_place = look_of(cloud);
  if (odom) tie(begun, *odom);
  const bool renews = params_.renew_m > 0.0 && odom && has_pose(graph_, odom->local_map);
  newest_ = renews ? make_room(begun) : volumes_.size();
  if (newest_ == volumes_.size()) {
    volumes_.push_back(std::move(begun));
  } else {
    begun.volume = SubVolume(params_, volumes_[newest_].volume.scans());
    begun.renewals = volumes_[newest_].renewals;
    volumes_[newest_] = std::move(begun);
  }
}

/// Forgets what the look is to take the place of, and says which id it is to have.
std::size_t VolumeMap::make_room(PlacedVolume& begun) {
  const Pose2 T_map_look = begun.T_map_volume * begun.T_volume_place;
  mark_what_was_left(volumes_, T_map_look, params_.renew_m);
  const auto older = looks_to_replace(volumes_, T_map_look, params_.renew_m);
  if (older.empty()) return free_id();
  const PlacedVolume& first = volumes_[older.front()];
  if (!first.was_left) {
    begun.T_volume_place = between(begun.T_map_volume, first.T_map_volume * first.T_volume_place);
  }
  for (const std::size_t i : older) forget(volumes_[i]);
  return older.front();
}

std::size_t VolumeMap::free_id() const {
  const auto free = std::ranges::find_if(
      volumes_, [](const PlacedVolume& placed) { return placed.volume.is_empty(); });
  return static_cast<std::size_t>(free - volumes_.begin());
}

/// It counts as one more scan, so that those who know it by its id hear of it.
void VolumeMap::forget(PlacedVolume& placed) const {
  const SubVolume& before = placed.volume;
  placed.volume = SubVolume(
      params_, VolumeContents{params_.cell_m, before.utime(), before.scans() + 1, {}, {}, 0});
  ++placed.renewals;
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
  if (odom_ && odom_->session != correction_->session) end_odom(correction_->utime);
  odom_ = {odom_ ? odom_->begin_utime : session_begin_utime_, TiedOdom::kNoEnd,
           correction_->session, correction_->local_map,
           between(T_map_local, correction_->T_map_odom)};
  leave_out_what_is_of_another_odom();
  for (PlacedVolume& placed : volumes_) {
    if (!placed.tie && !placed.left_out) tie(placed, *odom_);
  }
}

void VolumeMap::end_odom(std::int64_t utime) {
  odom_->end_utime = utime;
  odom_before_ = std::exchange(odom_, std::nullopt);
  session_begin_utime_ = utime;
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

void VolumeMap::tie(PlacedVolume& placed, const TiedOdom& odom) const {
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
