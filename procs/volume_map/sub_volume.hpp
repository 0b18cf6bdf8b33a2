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
#include "common/geometry/pose2.hpp"
#include "common/types/cloud.hpp"
#include "common/volume/voxel_grid.hpp"
#include "procs/volume_map/cell_set.hpp"
#include "procs/volume_map/occupancy_tree.hpp"
#include "procs/volume_map/scan_cells.hpp"

namespace adit {

struct SubVolumeParams {
  double cell_m = 0.1;        ///< side of the smallest cells
  double range_max_m = 20.0;  ///< up to which beams count; further away their lines are far apart
  double point_spacing_m = 0.05;  ///< of the points that are kept for a cloud

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

/// What a closed sub-volume is.
struct VolumeContents {
  double cell_m = 0.0;
  std::int64_t utime = 0;
  int scans = 0;
  std::vector<std::uint8_t> octree;
  std::vector<VolumePoint> points;
  std::int64_t rejected_points = 0;
};

/// What one or more 3D scans from about one place say of the rock around it, in the frame "volume":
/// see common/volume/volume.hpp. Each cell is measured once by each scan, as free where beams
/// passed and none ended, and as occupied where any ended (as octomap::OcTree::insertPointCloud
/// does).
class SubVolume {
 public:
  static constexpr float kOriginMaxM = 10.0F;  ///< so that the cells of a scan are bounded

  /// `scans_before`: of those that it takes the place of, over which the count goes on.
  explicit SubVolume(const SubVolumeParams& params, int scans_before = 0);
  /// A closed one, as it was.
  SubVolume(const SubVolumeParams& params, VolumeContents contents);

  /// In any order, while it is open.
  void insert(const Cloud& cloud, const Pose2& T_volume_level);

  /// Gives up what is needed to insert more. What remains is the most likely state of each cell,
  /// some 20 kB for a scan in a mine, and the points, 0.2 to 1 MB.
  void close();

  /// They are elsewhere, and take no room any more.
  void release_points();

  [[nodiscard]] bool is_open() const { return open_.has_value(); }
  /// Nothing was seen, or it was forgotten.
  [[nodiscard]] bool is_empty() const {
    return octree_.empty() && points_.empty() && released_points_ == 0;
  }
  [[nodiscard]] double cell_m() const { return params_.cell_m; }
  [[nodiscard]] std::int64_t utime() const { return utime_; }  ///< of the newest scan
  [[nodiscard]] int scans() const { return scans_; }
  /// The most likely state of each cell, see common/volume/octree_stream.hpp.
  [[nodiscard]] const std::vector<std::uint8_t>& octree() const { return octree_; }
  [[nodiscard]] std::int64_t occupied() const { return occupied_; }  ///< cells
  [[nodiscard]] std::int64_t free() const { return free_; }          ///< cells
  /// Of each cell of `point_spacing_m` the first point in it, however far away; those that came
  /// since they were forgotten.
  [[nodiscard]] const std::vector<VolumePoint>& points() const { return points_; }
  [[nodiscard]] std::size_t released_points() const { return released_points_; }
  /// That were no numbers or more than 2^15 cells away, or whose beams began so far from the body
  /// that no laser of it can have been there (kOriginMaxM).
  [[nodiscard]] std::int64_t rejected_points() const { return rejected_points_; }

 private:
  struct Open {
    OccupancyTree tree;
    std::unordered_set<VoxelCode> with_point;  ///< cells of `point_spacing_m`
  };

  void count();
  void insert_line(const CloudLine& line, std::int32_t scan, ScanCells& cells);

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
