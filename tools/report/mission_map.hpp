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

/// The map of a mission as the log leaves it: local maps where the last pose graph has them, and
/// the path that hangs on them. Without local maps odom stands for map.
class MissionMap {
 public:
  /// `record` gives its local maps away, and must outlive this.
  explicit MissionMap(MapRecord& record);
  MissionMap(const MissionMap&) = delete;
  MissionMap& operator=(const MissionMap&) = delete;

  /// It refers to this.
  [[nodiscard]] const FullMap& full_map() const { return full_map_; }
  /// T_map_body, all sessions in order of time.
  [[nodiscard]] const Trajectory& path() const { return path_; }
  [[nodiscard]] std::optional<Pose2> T_map_body_at(std::int64_t utime) const;
  /// Local maps that the graph knows and the log does not have.
  [[nodiscard]] std::size_t missing_local_maps() const { return missing_; }

  /// Nothing where there is no scan, or the poses are so far apart that a grid would not hold them.
  [[nodiscard]] std::optional<OccupancyGrid> grid(const Lasers& lasers) const;

 private:
  void set_graph(const MapRecord& record);
  void add_sessions(const Trajectory& odometry);
  void add_placed_scans();

  std::vector<LocalMap> local_maps_;
  FullMap full_map_;
  Trajectory path_;
  std::size_t missing_ = 0;
};

}  // namespace adit
