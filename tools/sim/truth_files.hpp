// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/world/world.hpp"

namespace adit {

/// Writes the ground truth of a world into a folder, which is created if needed: tunnels.geojson
/// (the centre-line graph, with lengths and widths), plan.geojson (the outline of rock, open space
/// on the left), obstacles.json. Coordinates are in metres in world. Throws std::runtime_error with
/// the path of a file that cannot be written.
void write_truth_files(const World& world, const std::filesystem::path& folder);

}  // namespace adit
