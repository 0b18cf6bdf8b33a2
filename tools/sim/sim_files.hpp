// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/types/cloud.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// Writes the ground truth of a world into a folder, which is created if needed: tunnels.geojson
/// (the centre-line graph, with lengths and widths), plan.geojson (the outline of rock, open space
/// on the left), obstacles.json. Coordinates are in metres in world. Throws std::runtime_error with
/// the path of a file that cannot be written.
void write_truth_files(const World& world, const std::filesystem::path& folder);

/// Which of these files are empty, and why: a sentence each. Imported meshes have no tunnels.
std::vector<std::string> missing_truth(const World& world);

/// Writes a 3D scan as an LCM log of its messages (.lcmlog), or its points only, in the frame level
/// (.ply). Throws std::runtime_error for another extension, or if the file cannot be written.
void write_scan(const Cloud& cloud, const std::filesystem::path& file);

}  // namespace adit
