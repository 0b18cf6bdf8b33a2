// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/map/run_record.hpp"
#include "tools/map/whole_map.hpp"

namespace adit {

struct MapFilesOptions {
  std::string title;
  OccupancyGridParams grid;
  Lasers lasers;
  bool draw_graph = false;
};

/// Writes trajectory.tum and odometry.tum, map.png, map.pgm and map.yaml into a folder. False where
/// the poses are so far apart that the grid would not hold them; the trajectories are written all
/// the same. Throws std::runtime_error where a file cannot be written.
bool write_map_files(const WholeMap& map, const RunRecord& record, const MapFilesOptions& options,
                     const std::filesystem::path& folder);

}  // namespace adit
