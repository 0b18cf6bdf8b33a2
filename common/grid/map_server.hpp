// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"

namespace adit {

/// Writes `stem`.pgm and `stem`.yaml into a folder, as ROS's map_server and nav2 read them:
/// trinary, the highest row first, origin at the lower left corner of the lowest cell. The margin
/// keeps one unknown cell around the map. The same map gives the same bytes. Throws
/// std::runtime_error where a file cannot be written.
void write_map_server(const OccupancyGrid& grid, const std::filesystem::path& folder,
                      const std::string& stem);

}  // namespace adit
