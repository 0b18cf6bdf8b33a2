// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/local_map.hpp"
#include "common/types/terrain_map.hpp"
#include "viewer/scene/anchored_path.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/scene/map_raster.hpp"
#include "viewer/scene/scene_parameters.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The whole map, /map: occupancy from the local maps at the poses of the pose graph, and how well
/// each place is known. Each local map is rasterised once; the cells become larger when all
/// rasters together exceed kRasterBytesMax.
class MapLayer {
 public:
  static constexpr std::size_t kRasterBytesMax = 48'000'000;

  /// All must outlive this.
  MapLayer(TopicBoard& board, const MapFrame& frame, const AnchoredPath& path,
           const SceneParameters& parameters);
  MapLayer(const MapLayer&) = delete;
  MapLayer& operator=(const MapLayer&) = delete;

  void add_local_map(const LocalMap& map, const Lasers& lasers);
  /// Adds a scan that is not in a local map yet, unless the robot has hardly moved since the last.
  void add_scan(const ScanMatch& match, const LaserScan& scan, const LaserMount& mount);
  void add_terrain(const TerrainMap& terrain);
  /// The pose graph or the driven path has changed.
  void set_changed(std::int64_t utime) { board_.set_changed(topic_, utime); }

 private:
  struct Scanned {
    AnchoredPose T_level;
    MapRaster raster;
  };
  struct Sum {
    std::uint32_t hits = 0;
    std::uint32_t misses = 0;
    Coverage coverage = Coverage::kNone;
  };

  void add_bytes(std::size_t bytes);
  [[nodiscard]] CellBox covered_box(double cell_m) const;
  void draw_path(Grid2<Sum>& sums, double cell_m) const;
  [[nodiscard]] std::string grid_message() const;

  /// Calls `draw` with each raster and its pose in map.
  template <class Draw>
  void for_each_raster(Draw draw) const;

  TopicBoard& board_;
  const MapFrame& frame_;
  const AnchoredPath& path_;
  const SceneParameters& parameters_;
  TopicId topic_ = 0;
  double cell_m_ = 0.1;
  std::size_t bytes_ = 0;
  std::int64_t utime_ = 0;
  std::map<int, MapRaster> local_maps_;  ///< by id
  std::vector<Scanned> scanned_;
  OccupancyGrid recent_;  ///< scans since the newest local map, in odom
  std::optional<Pose2> T_odom_recent_;
};

}  // namespace adit
