// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/local_map.hpp"
#include "tools/map/full_map.hpp"
#include "tools/report/records/map_record.hpp"

namespace adit {

/// The map at the end of a log: local maps at the poses of the last pose graph, and the path
/// corrected accordingly. Without local maps the path is odometry, and map is odom.
class MissionMap {
 public:
  /// Takes the local maps out of `record`, which must outlive this.
  explicit MissionMap(MapRecord& record);
  MissionMap(const MissionMap&) = delete;
  MissionMap& operator=(const MissionMap&) = delete;

  /// Refers to this object.
  [[nodiscard]] const FullMap& full_map() const { return full_map_; }
  /// T_map_body of all sessions, in order of time.
  [[nodiscard]] const Trajectory& path() const { return path_; }
  [[nodiscard]] std::optional<Pose2> T_map_body_at(std::int64_t utime) const;
  /// Number of local maps that are in the pose graph but not in the log.
  [[nodiscard]] std::size_t missing_local_maps() const { return missing_; }

  /// Nothing without scans, or if the poses exceed the size of a grid.
  [[nodiscard]] std::optional<OccupancyGrid> grid(const Lasers& lasers) const;

 private:
  void set_graph(const MapRecord& record);
  void add_sessions(const Trajectory& odometry);
  [[nodiscard]] bool visit_scans(const FullMap::UseScan& use) const;

  std::vector<LocalMap> local_maps_;
  FullMap full_map_;
  Trajectory path_;
  std::size_t missing_ = 0;
};

}  // namespace adit
