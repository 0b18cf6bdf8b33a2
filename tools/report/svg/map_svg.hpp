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

/// Where a 3D scan was taken, to be marked on the map.
struct ScanMark {
  int number = 0;
  Pose2 T_map_ahead;  ///< its heading is where the laser looked, ahead or behind
  bool found = true;  ///< a path came of it
  std::string text;   ///< for who points at it
};

/// What is to be seen on the map of a mission.
struct MapContent {
  const MissionMap* map = nullptr;
  const OccupancyGrid* grid = nullptr;             ///< may be null
  const ExplorationReport* exploration = nullptr;  ///< may be null
  std::vector<ScanMark> scans;
  std::optional<std::int64_t> homeward_utime;  ///< from when on the way leads home
};

/// The map as an <svg> for a page; the numbers of scans lead to "#scan-1" and so on, the openings
/// to "#stub-0". Classes of its parts are those of map_style.
std::string map_svg(const MapContent& map);

/// The same as a file of its own, with a title and what the colours mean.
std::string map_svg_file(const MapContent& map, const std::string& title);

/// CSS of the map's parts. The colours are variables, which `map_colours` defines.
const char* map_style();
const char* map_colours();

}  // namespace adit
