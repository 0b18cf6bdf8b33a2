// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sim/world/world.hpp"

namespace adit {

/// Writes what is true of a world into a folder, made if it is not there: drifts.geojson (the
/// centre-line graph, with lengths and widths), plan.geojson (the outline of rock, open space on
/// the left), obstacles.json. Coordinates are metres in world. Throws std::runtime_error with the
/// path of what cannot be written.
void write_truth_files(const World& world, const std::filesystem::path& folder);

}  // namespace adit
