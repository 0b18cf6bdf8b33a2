// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "procs/volume_map/volume_map.hpp"

namespace adit {

/// The points of all scans in map [m], each with the id of its scan, as binary PLY (little-endian).
/// Throws std::runtime_error where the file cannot be written.
void write_ply(const VolumeMap& map, const std::filesystem::path& path);

/// volume.bt and volume.ot, see VolumeMap::merged and OccupancyTree, and cloud.ply, into a folder
/// that is there. Throws std::runtime_error where a file cannot be written.
void export_volume(const VolumeMap& map, const std::filesystem::path& folder);

}  // namespace adit
