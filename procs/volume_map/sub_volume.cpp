// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/sub_volume.hpp"

#include <algorithm>
#include <utility>

#include "common/volume/volume.hpp"

namespace adit {
namespace {

/// Rounding to single precision moves a point by less than 1e-6 of its distance.
Eigen::Vector3f move(const LevelPose& T_a_b, const Eigen::Vector3f& p_b) {
  return (T_a_b * Eigen::Vector3d(p_b.cast<double>())).cast<float>();
}

CloudLine move(const LevelPose& T_a_b, const CloudLine& line) {
  CloudLine moved{line.utime, move(T_a_b, line.origin), {}, {}};
  moved.points.reserve(line.points.size());
  for (const Eigen::Vector3f& p : line.points) moved.points.push_back(move(T_a_b, p));
  return moved;
}

/// The lines of a cloud in the frame of the volume, without those whose origin is invalid.
Cloud in_volume(const Cloud& cloud, const LevelPose& T_volume_level) {
  Cloud scan;
  scan.utime = cloud.utime;
  scan.id = cloud.id;
  for (const CloudLine& line : cloud.lines) {
    if (line.origin.norm() <= SubVolume::kOriginMaxM) {
      scan.lines.push_back(move(T_volume_level, line));
    }
  }
  return scan;
}

std::int64_t points_of(const Cloud& cloud) { return static_cast<std::int64_t>(cloud.points()); }

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
  count_cells_of_octree();
}

void SubVolume::count_cells_of_octree() {
  const OctreeCounts counts = count_cells(octree_);
  occupied_ = counts.occupied;
  free_ = counts.free;
}

/// Sections and equations of Hornung et al. 2013 (OctoMap).
void SubVolume::insert(const Cloud& cloud, const LevelPose& T_volume_level) {
  const Cloud scan = in_volume(cloud, T_volume_level);
  const ScanCells cells = trace_beams(scan);              // section 5.1: ray casting
  const auto runs = runs_of(cells.free, cells.occupied);  // section 5.1: occupied takes precedence
  open_->tree.update(runs);                               // eqs. 2, 4: log-odds with clamping
  octree_ = open_->tree.stream();                         // section 3.5: most likely states
  add_points(scan);
  count_cells_of_octree();
  rejected_points_ += cells.rejected_points + points_of(cloud) - points_of(scan);
  utime_ = std::max(utime_, cloud.utime);
  ++scans_;
}

/// The cells that the beams of a scan traverse and end in.
ScanCells SubVolume::trace_beams(const Cloud& scan) const {
  ScanCells cells;
  const VoxelGrid grid(params_.cell_m);
  for (const CloudLine& line : scan.lines) add_line(grid, line, params_.range_max_m, cells);
  return cells;
}

/// Thins out the points to one per cell of `point_spacing_m`, for export.
void SubVolume::add_points(const Cloud& scan) {
  const VoxelGrid grid(params_.point_spacing_m);
  for (const CloudLine& line : scan.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const auto keys = grid.keys_of(p);
      const bool is_new = keys && open_->with_point.insert(VoxelGrid::code_of(*keys)).second;
      if (is_new) points_.push_back({p, scan.id});
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
