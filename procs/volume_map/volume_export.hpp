// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// Writes the points of all scans in map [m], each with the id of its scan, as binary PLY
/// (little-endian). Throws std::runtime_error if the file cannot be written.
void write_ply(const VolumeMap& map, const std::filesystem::path& path);

/// Writes volume.bt and volume.ot (see VolumeMap::merged and OccupancyTree) and cloud.ply into an
/// existing folder. Throws std::runtime_error if a file cannot be written.
void export_volume(const VolumeMap& map, const std::filesystem::path& folder);

}  // namespace adit
