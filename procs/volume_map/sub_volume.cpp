// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/sub_volume.hpp"

#include <algorithm>
#include <utility>

#include "common/volume/volume.hpp"

namespace adit {
namespace {

/// In single precision a point moves by less than 1e-6 of its distance.
Eigen::Vector3f move(const Pose2& T_a_b, const Eigen::Vector3f& p_b) {
  const Eigen::Vector2d p_a = T_a_b * Eigen::Vector2d(p_b.head<2>().cast<double>());
  return {static_cast<float>(p_a.x()), static_cast<float>(p_a.y()), p_b.z()};
}

CloudLine move(const Pose2& T_a_b, const CloudLine& line) {
  CloudLine moved{line.utime, move(T_a_b, line.origin), {}, {}};
  moved.points.reserve(line.points.size());
  for (const Eigen::Vector3f& p : line.points) moved.points.push_back(move(T_a_b, p));
  return moved;
}

}  // namespace

SubVolume::SubVolume(const SubVolumeParams& params, int scans_before)
    : params_(params), open_(Open{OccupancyTree(params.cell_m), {}}), scans_(scans_before) {}

SubVolume::SubVolume(const SubVolumeParams& params, VolumeContents contents)
    : params_(params),
      utime_(contents.utime),
      scans_(contents.scans),
      octree_(std::move(contents.octree)),
      points_(std::move(contents.points)),
      rejected_points_(contents.rejected_points) {
  count();
}

void SubVolume::count() {
  const OctreeCounts counts = count_cells(octree_);
  occupied_ = counts.occupied;
  free_ = counts.free;
}

void SubVolume::insert(const Cloud& cloud, const Pose2& T_volume_level) {
  ScanCells cells;
  for (const CloudLine& line : cloud.lines) {
    if (line.origin.norm() <= kOriginMaxM) {
      insert_line(move(T_volume_level, line), cloud.id, cells);
    } else {
      cells.rejected_points += static_cast<std::int64_t>(line.points.size());
    }
  }
  open_->tree.update(runs_of(cells.free, cells.occupied));
  rejected_points_ += cells.rejected_points;
  utime_ = std::max(utime_, cloud.utime);
  ++scans_;
  octree_ = open_->tree.stream();
  count();
}

void SubVolume::insert_line(const CloudLine& line, std::int32_t scan, ScanCells& cells) {
  add_line(VoxelGrid(params_.cell_m), line, params_.range_max_m, cells);
  const VoxelGrid point_grid(params_.point_spacing_m);
  for (const Eigen::Vector3f& p : line.points) {
    const auto keys = point_grid.keys_of(p);
    if (keys && open_->with_point.insert(VoxelGrid::code_of(*keys)).second) {
      points_.push_back({p, scan});
    }
  }
}

void SubVolume::close() {
  open_.reset();
  points_.shrink_to_fit();
}

void SubVolume::release_points() {
  released_points_ += points_.size();
  points_ = {};
}

}  // namespace adit
