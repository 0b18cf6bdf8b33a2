// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/level_pose.hpp"
#include "common/volume/volume.hpp"
#include "procs/volume_map/scan_cells.hpp"
#include "procs/volume_map/sub_volume.hpp"

namespace adit {
namespace {

/// Transfers cells of a sub-volume to cells of map of the same size. Cells outside the grid are
/// dropped.
class Resampler {
 public:
  Resampler(double cell_m, const LevelPose& T_map_volume)
      : grid_(cell_m),
        T_map_volume_(T_map_volume.plan),
        rise_cells_(std::lround(T_map_volume.z_m / cell_m)) {}

  void add_centre(const VoxelGrid::Keys& keys, CellSet& set) const { add(keys, 0.0, 0.0, set); }

  /// Four samples half a cell apart: at any rotation no cell of map lies between them.
  void add_quarters(const VoxelGrid::Keys& keys, CellSet& set) const {
    const double quarter = 0.25 * grid_.cell_m();
    for (const double dx : {-quarter, quarter}) {
      for (const double dy : {-quarter, quarter}) add(keys, dx, dy, set);
    }
  }

 private:
  void add(const VoxelGrid::Keys& keys, double dx, double dy, CellSet& set) const {
    const Eigen::Vector3d p_volume = grid_.centre_m(keys);
    const Eigen::Vector2d p_map =
        T_map_volume_ * Eigen::Vector2d(p_volume.x() + dx, p_volume.y() + dy);
    const auto at =
        grid_.keys_of({static_cast<float>(p_map.x()), static_cast<float>(p_map.y()), 0.0F});
    const std::int64_t z_key = keys.z() + rise_cells_;
    if (!at || z_key < 0 || z_key >= std::int64_t{2} * VoxelGrid::kKeyOfOrigin) return;
    set.insert(VoxelGrid::code_of({at->x(), at->y(), static_cast<int>(z_key)}));
  }

  VoxelGrid grid_;
  Pose2 T_map_volume_;
  std::int64_t rise_cells_;  // rounding cell by cell could leave a layer empty
};

/// Transfers the centre of each occupied cell, so that walls do not become thicker, and four points
/// of each free cell, so that rotated cells leave no holes in free space.
void resample(const SubVolume& volume, const LevelPose& T_map_volume, CellSet& free,
              CellSet& occupied) {
  const Resampler resampler(volume.cell_m(), T_map_volume);
  visit_leaves(volume.octree(), [&](const CellRun& leaf) {
    for (VoxelCode cell = leaf.first; cell < leaf.end; ++cell) {
      const VoxelGrid::Keys keys = VoxelGrid::keys_at(cell);
      if (leaf.occupied) {
        resampler.add_centre(keys, occupied);
      } else {
        resampler.add_quarters(keys, free);
      }
    }
  });
}

bool has_pose(const MapGraph& graph, int local_map) {
  return local_map >= 0 && static_cast<std::size_t>(local_map) < graph.poses.size();
}

/// T_map_local. Height 0 where the graph has none.
LevelPose pose(const MapGraph& graph, int local_map) {
  const auto id = static_cast<std::size_t>(local_map);
  return {graph.poses[id], id < graph.z_m.size() ? graph.z_m[id] : 0.0};
}

LevelPose T_odom_level(const Cloud& cloud) { return {cloud.T_odom_level, cloud.z_odom_m}; }

}  // namespace

void VolumeMap::restore(StoredVolumes stored) {
  scan_utimes_ = std::move(stored.scan_utimes);
  for (StoredVolume& volume : stored.volumes) {
    if (volume.contents.cell_m != params_.cell_m) {
      throw std::runtime_error(
          fmt::format("the stored volume has cells of {:f} m, the configuration {:f} m",
                      volume.contents.cell_m, params_.cell_m));
    }
    volumes_.push_back({SubVolume(params_, std::move(volume.contents)), volume.T_odom_volume,
                        volume.anchor, volume.T_odom_volume, false, 0, volume.T_volume_viewpoint,
                        true});
  }
  restored_ = volumes_.size();
  newest_ = volumes_.empty() ? 0 : volumes_.size() - 1;
  if (!stored.odom || stored.odom->begin_utime == 0) return;
  (stored.odom->end_utime == AnchoredOdom::kNoEnd ? odom_ : previous_odom_) = stored.odom;
}

void VolumeMap::release_points() {
  for (PlacedVolume& placed : volumes_) placed.volume.release_points();
}

bool VolumeMap::has(std::int64_t utime) const {
  return std::ranges::find(scan_utimes_, utime) != scan_utimes_.end();
}

void VolumeMap::set_odom_epoch(std::int64_t utime) {
  if (std::exchange(has_odom_epoch_, true)) return;
  if (odom_ && odom_->begin_utime == 0) odom_->begin_utime = utime;
  if (odom_ && utime > odom_->begin_utime) return end_odom(utime);
  if (previous_odom_ && previous_odom_->has(utime)) {
    // The previous frame ended when this one began, not when a correction reported it.
    previous_odom_->end_utime = utime;
    session_begin_utime_ = utime;
  }
  session_begin_utime_ = std::max(session_begin_utime_, utime);
}

std::int64_t VolumeMap::localized_from_utime() const {
  return previous_odom_ ? previous_odom_->begin_utime : session_begin_utime_;
}

bool VolumeMap::add(const Cloud& cloud) {
  scan_utimes_.push_back(cloud.utime);
  if (!can_localize(cloud)) {
    ++excluded_;
    return false;
  }
  const auto& odom = is_older_than_session(cloud) ? previous_odom_ : odom_;
  if (!newest_accepts(cloud, odom)) begin_volume(cloud, odom);
  PlacedVolume& newest = volumes_[newest_];
  const LevelPose T_volume_level = between(newest.T_odom_volume, T_odom_level(cloud));
  newest.volume.insert(cloud, T_volume_level);
  return true;
}

bool VolumeMap::is_older_than_session(const Cloud& cloud) const {
  return cloud.utime < session_begin_utime_;
}

/// A scan of an earlier session needs the odom frame that it was taken in.
bool VolumeMap::can_localize(const Cloud& cloud) const {
  return !is_older_than_session(cloud) || (previous_odom_ && previous_odom_->has(cloud.utime));
}

bool VolumeMap::newest_accepts(const Cloud& cloud, const std::optional<AnchoredOdom>& odom) const {
  if (volumes_.empty() || !volumes_[newest_].volume.is_open()) return false;
  const PlacedVolume& newest = volumes_[newest_];
  if (newest.anchor.has_value() != odom.has_value()) return false;
  if (odom && newest.anchor->local_map != odom->local_map) return false;
  const LevelPose T_volume_level = between(newest.T_odom_volume, T_odom_level(cloud));
  if (params_.replace_radius_m > 0.0) {
    return is_same_viewpoint(newest.T_volume_viewpoint, T_volume_level * viewpoint_of(cloud),
                             params_.replace_radius_m);
  }
  return T_volume_level.translation().norm() <= params_.span_m;
}

void VolumeMap::begin_volume(const Cloud& cloud, const std::optional<AnchoredOdom>& odom) {
  if (!volumes_.empty()) volumes_[newest_].volume.close();
  PlacedVolume created{SubVolume(params_), T_odom_level(cloud), {}, T_odom_level(cloud), false};
  created.T_volume_viewpoint = viewpoint_of(cloud);
  if (odom) anchor(created, *odom);
  const bool replaces = params_.replace_radius_m > 0.0 && odom && has_pose(graph_, odom->local_map);
  newest_ = replaces ? replace_older(created) : volumes_.size();
  if (newest_ == volumes_.size()) {
    volumes_.push_back(std::move(created));
  } else {
    created.volume = SubVolume(params_, volumes_[newest_].volume.scans());
    created.replacements = volumes_[newest_].replacements;
    volumes_[newest_] = std::move(created);
  }
}

/// Discards the volumes that the new one replaces, and returns the id for the new one.
std::size_t VolumeMap::replace_older(PlacedVolume& created) {
  const LevelPose T_map_viewpoint = created.T_map_volume * created.T_volume_viewpoint;
  mark_departed(volumes_, T_map_viewpoint, params_.replace_radius_m);
  const auto older = volumes_to_replace(volumes_, T_map_viewpoint, params_.replace_radius_m);
  if (older.empty()) return free_id();
  const PlacedVolume& first = volumes_[older.front()];
  if (!first.departed) {
    created.T_volume_viewpoint =
        between(created.T_map_volume, first.T_map_volume * first.T_volume_viewpoint);
  }
  for (const std::size_t i : older) discard(volumes_[i]);
  return older.front();
}

std::size_t VolumeMap::free_id() const {
  const auto free = std::ranges::find_if(
      volumes_, [](const PlacedVolume& placed) { return placed.volume.is_empty(); });
  return static_cast<std::size_t>(free - volumes_.begin());
}

/// Counts as one more scan, so that subscribers receive the empty volume.
void VolumeMap::discard(PlacedVolume& placed) const {
  const SubVolume& before = placed.volume;
  placed.volume = SubVolume(
      params_, VolumeContents{params_.cell_m, before.utime(), before.scans() + 1, {}, {}, 0});
  ++placed.replacements;
}

void VolumeMap::set_graph(const MapGraph& graph) {
  graph_ = graph;
  graph_.constraints.clear();
  for (PlacedVolume& placed : volumes_) {
    if (!placed.anchor || !has_pose(graph_, placed.anchor->local_map)) continue;
    placed.T_map_volume = pose(graph_, placed.anchor->local_map) * placed.anchor->T_local_volume;
  }
  update_anchor();
}

void VolumeMap::set_correction(const MapCorrection& correction) {
  correction_ = correction;
  update_anchor();
}

/// The pose of odom in the newest local map does not depend on the graph, but is computed from
/// graph and correction of the same revision.
void VolumeMap::update_anchor() {
  if (!correction_ || correction_->revision != graph_.revision) return;
  if (!has_pose(graph_, correction_->local_map)) return;
  const LevelPose T_map_local = pose(graph_, correction_->local_map);
  if (odom_ && odom_->session != correction_->session) end_odom(correction_->utime);
  odom_ = {odom_ ? odom_->begin_utime : session_begin_utime_, AnchoredOdom::kNoEnd,
           correction_->session, correction_->local_map,
           between(T_map_local, {correction_->T_map_odom, correction_->z_map_odom_m})};
  exclude_restored_volumes_of_other_odom();
  for (PlacedVolume& placed : volumes_) {
    if (!placed.anchor && !placed.excluded) anchor(placed, *odom_);
  }
}

void VolumeMap::end_odom(std::int64_t utime) {
  odom_->end_utime = utime;
  previous_odom_ = std::exchange(odom_, std::nullopt);
  session_begin_utime_ = utime;
}

/// A restored volume without an anchor was observed before the first local map, that is in the
/// first session.
void VolumeMap::exclude_restored_volumes_of_other_odom() {
  if (restored_ == 0) return;
  const auto end = volumes_.begin() + static_cast<std::ptrdiff_t>(std::exchange(restored_, 0));
  if (odom_->session == 0) return;
  for (auto placed = volumes_.begin(); placed != end; ++placed) {
    if (placed->anchor) continue;
    excluded_ += placed->volume.scans();
    placed->excluded = true;
  }
}

void VolumeMap::anchor(PlacedVolume& placed, const AnchoredOdom& odom) const {
  placed.anchor = {odom.local_map, odom.T_local_odom * placed.T_odom_volume};
  if (!has_pose(graph_, odom.local_map)) return;
  placed.T_map_volume = pose(graph_, odom.local_map) * placed.anchor->T_local_volume;
}

std::int64_t VolumeMap::rejected_points() const {
  std::int64_t n = 0;
  for (const PlacedVolume& placed : volumes_) n += placed.volume.rejected_points();
  return n;
}

OccupancyTree VolumeMap::merged() const {
  CellSet free;
  CellSet occupied;
  for (const PlacedVolume& placed : volumes_) {
    if (placed.excluded) continue;
    resample(placed.volume, placed.T_map_volume, free, occupied);
  }
  OccupancyTree tree(params_.cell_m);
  tree.update(runs_of(free, occupied));
  return tree;
}

}  // namespace adit
