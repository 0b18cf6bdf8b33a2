// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/files/spool.hpp"
#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/association.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/local_map_store.hpp"
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
Spool<TimedPose> corrected_path(const Spool<TimedPose>& odometry,
                                const std::vector<MapAnchor>& anchors,
                                const std::filesystem::path& scratch);

/// A scan with its pose in the map.
struct PlacedScan {
  const std::string* channel = nullptr;
  const LaserScan* scan = nullptr;
  Pose2 T_map_body;
  std::size_t path = 0;  ///< of FullMap::paths, on which it was taken
};

/// The map at the end of a run, including earlier sessions. Refers to the data of both, which must
/// outlive it.
struct FullMap {
  std::vector<const LocalMap*> local_maps;  ///< by id; see LocalMapStore for their scans
  std::vector<const Association*> associations;
  MapGraph graph;  ///< empty without local maps

  /// T_map_body, one path per session: at the stored scans for earlier ones, at all scans for this
  /// one.
  std::vector<Spool<TimedPose>> paths;

  /// Passes the scans for the grid to `use`, those of the local maps and those after the last local
  /// map, until it returns false; true if it did not.
  using UseScan = std::function<bool(const PlacedScan&)>;
  std::function<bool(const FullMap&, const UseScan& use)> visit_scans;
};

/// What a run continues.
struct EarlierMap {
  LocalMapStore maps;
  std::vector<Association> associations;
};

/// Long paths are in temporary files in `scratch`.
FullMap full_map(const EarlierMap& earlier, const RunRecord& record,
                 const std::filesystem::path& scratch = std::filesystem::temp_directory_path());

/// A map without a run that continues it.
FullMap full_map(const LocalMapStore& maps, MapGraph graph,
                 const std::filesystem::path& scratch = std::filesystem::temp_directory_path());

/// Passes the poses of all paths to `use`, in order of time. Of two poses with the same time, the
/// one of the later session is used.
void visit_joined_path(const FullMap& map, const std::function<void(const TimedPose&)>& use);
/// All of them.
Trajectory joined_path(const FullMap& map);

/// Inserts all scans of a map into a grid. False if the poses exceed the size of the grid.
bool insert_scans(const FullMap& map, const Lasers& lasers, OccupancyGrid& grid);

/// Number of accepted loop closures between the last session and earlier ones.
std::size_t count_cross_session_loop_closures(const FullMap& map);

}  // namespace adit
