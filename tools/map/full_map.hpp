// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/mapping.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// Start of a local map, which anchors odom to map there by T_map_local · T_odom_local⁻¹.
struct MapAnchor {
  std::int64_t utime = 0;  ///< [µs since the epoch]
  Pose2 T_odom_local;
  Pose2 T_map_local;
  double z_map_odom_m = 0.0;  ///< height of odom in map
};

/// That of a local map of the graph.
MapAnchor map_anchor(const LocalMap& map, const MapGraph& graph);

/// The trajectory of one session in map: T_map_body for each T_odom_body. A pose between the starts
/// of two local maps gets a blend of their corrections. The weight is the share of the distance
/// travelled, rotation included (1 m per radian), so that the path is continuous and does not move
/// while the body rests. Poses before the first anchor get its correction, poses after the last one
/// that of the last; without anchors map is odom. `anchors` must be in order of time.
Trajectory corrected_trajectory(const Trajectory& odometry, const std::vector<MapAnchor>& anchors);

/// A scan with its pose in the map.
struct PlacedScan {
  const std::string* channel = nullptr;
  const LaserScan* scan = nullptr;
  Pose2 T_map_body;
};

/// The map at the end of a run, including earlier sessions. Refers to the data of both, which must
/// outlive it.
struct FullMap {
  std::vector<const LocalMap*> local_maps;  ///< by id
  std::vector<const Association*> associations;
  MapGraph graph;  ///< empty without local maps

  /// T_map_body, one path per session: at the stored scans for earlier ones, at all scans for this
  /// one.
  std::vector<Trajectory> paths;
  /// Scans for the grid: those of the local maps and those after the last local map.
  std::vector<PlacedScan> scans;
};

FullMap full_map(const StoredMap& earlier, const RunRecord& record);

/// All paths in one trajectory, in order of time. Of two poses with the same time, the one of the
/// later session is used.
Trajectory joined_path(const FullMap& map);

/// Inserts all scans of a map into a grid. False if the poses exceed the size of the grid.
bool insert_scans(const FullMap& map, const Lasers& lasers, OccupancyGrid& grid);

/// Number of accepted loop closures between the last session and earlier ones.
std::size_t count_cross_session_loop_closures(const FullMap& map);

}  // namespace adit
