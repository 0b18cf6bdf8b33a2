// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/level_pose.hpp"
#include "common/types/cloud.hpp"
#include "common/volume/voxel_grid.hpp"
#include "procs/volume_map/occupancy_tree.hpp"
#include "procs/volume_map/scan_cells.hpp"

namespace adit {

struct SubVolumeParams {
  double cell_m = 0.1;            ///< side of a cell
  double range_max_m = 20.0;      ///< range up to which beams count; beyond it lines are far apart
  double point_spacing_m = 0.05;  ///< spacing of the points stored for export

  template <class V>
  void visit(V& v) {
    v("cell_m", cell_m, within(0.02, 1.0));
    v("range_max_m", range_max_m, within(1.0, 100.0));
    v("point_spacing_m", point_spacing_m, within(0.01, 1.0));
  }
};

/// A point of a 3D scan.
struct VolumePoint {
  Eigen::Vector3f p_volume{0.0F, 0.0F, 0.0F};
  std::int32_t scan = 0;  ///< id of the cloud
};

/// State of a closed sub-volume.
struct VolumeContents {
  double cell_m = 0.0;
  std::int64_t utime = 0;
  int scans = 0;
  std::vector<std::uint8_t> octree;
  std::vector<VolumePoint> points;
  std::int64_t rejected_points = 0;
};

/// Occupancy of the rock around one place from one or more 3D scans, in the frame "volume" (see
/// common/volume/volume.hpp), after Hornung et al. 2013 (OctoMap). Each scan is one measurement of
/// each cell: occupied if any beam ends in it, otherwise free if any beam traverses it (section 5.1
/// there, and octomap::OcTree::insertPointCloud).
class SubVolume {
 public:
  static constexpr float kOriginMaxM = 10.0F;  ///< bounds the number of cells of a scan

  /// `scans_before`: number of scans of the volumes it replaces, from which the count continues.
  explicit SubVolume(const SubVolumeParams& params, int scans_before = 0);
  /// A closed one, from its stored state.
  SubVolume(const SubVolumeParams& params, VolumeContents contents);

  /// Inserts a scan, in any order of time. The sub-volume must be open.
  void insert(const Cloud& cloud, const LevelPose& T_volume_level);

  /// Frees the data for further insertions. The most likely state of each cell remains, about 20 kB
  /// for a scan in a mine, and the points, 0.2 to 1 MB.
  void close();

  /// Frees the points, which are stored elsewhere.
  void release_points();

  [[nodiscard]] bool is_open() const { return open_.has_value(); }
  /// Nothing was observed, or it was discarded.
  [[nodiscard]] bool is_empty() const {
    return octree_.empty() && points_.empty() && released_points_ == 0;
  }
  [[nodiscard]] double cell_m() const { return params_.cell_m; }
  [[nodiscard]] std::int64_t utime() const { return utime_; }  ///< of the newest scan
  [[nodiscard]] int scans() const { return scans_; }
  /// The most likely state of each cell, see common/volume/volume.hpp.
  [[nodiscard]] const std::vector<std::uint8_t>& octree() const { return octree_; }
  [[nodiscard]] std::int64_t occupied() const { return occupied_; }  ///< cells
  [[nodiscard]] std::int64_t free() const { return free_; }          ///< cells
  /// The first point in each cell of `point_spacing_m`, at any range; those added since the points
  /// were released.
  [[nodiscard]] const std::vector<VolumePoint>& points() const { return points_; }
  [[nodiscard]] std::size_t released_points() const { return released_points_; }
  /// Points that are not finite or more than 2^15 cells away, or whose beam begins farther from the
  /// body than any of its lasers is mounted (kOriginMaxM).
  [[nodiscard]] std::int64_t rejected_points() const { return rejected_points_; }

 private:
  struct Open {
    OccupancyTree tree;
    std::unordered_set<VoxelCode> with_point;  ///< cells of `point_spacing_m` that have a point
  };

  [[nodiscard]] ScanCells trace_beams(const Cloud& scan) const;
  void add_points(const Cloud& scan);
  void count_cells_of_octree();

  SubVolumeParams params_;
  std::optional<Open> open_;
  std::int64_t utime_ = 0;
  int scans_ = 0;
  std::vector<std::uint8_t> octree_;
  std::int64_t occupied_ = 0;
  std::int64_t free_ = 0;
  std::vector<VolumePoint> points_;
  std::size_t released_points_ = 0;
  std::int64_t rejected_points_ = 0;
};

}  // namespace adit
