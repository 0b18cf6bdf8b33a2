// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tools/map/run_record.hpp"

namespace adit {

/// Writes trajectory.tum, map.png, map.pgm and map.yaml of a run into a folder. False where the
/// poses are so far apart that the grid would not hold them; the trajectory is written all the
/// same. Throws std::runtime_error where a file cannot be written.
bool write_map_files(const RunRecord& record, const ScanMatchingParams& lasers,
                     const OccupancyGridParams& grid, const std::string& title,
                     const std::filesystem::path& folder);

}  // namespace adit
