// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/types/exploration.hpp"
#include "tools/report/mission_map.hpp"

namespace adit {

/// A 3D scan on the map.
struct ScanMark {
  int number = 0;
  Pose2 T_map_laser;     ///< position of the body, heading of the laser that scanned
  bool has_path = true;  ///< the planner found a path
  std::string text;      ///< tooltip
};

/// Content of the map of a mission.
struct MapContent {
  const MissionMap* map = nullptr;
  const OccupancyGrid* grid = nullptr;             ///< may be null
  const ExplorationReport* exploration = nullptr;  ///< may be null
  std::vector<ScanMark> scans;
  std::optional<std::int64_t> return_home_utime;  ///< start of the return path
};

/// The map as an SVG file with style, title and legend. Scans link to "mission.html#scan-1" and so
/// on, frontiers to "mission.html#frontier-0".
std::string map_svg_file(const MapContent& map, const std::string& title);

}  // namespace adit
