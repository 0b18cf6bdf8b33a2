// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/picture/rgb_image.hpp"
#include "common/terrain/terrain_map.hpp"

namespace adit {

/// A pixel for each cell, x to the right and y up: seen ground in grey, the brighter the easier to
/// pass (the paper's figure 5b), black from a coefficient of 0.5 m on; unknown ground in the colour
/// of its class.
RgbImage terrain_image(const TerrainMap& map);

/// Draws the same as PNG, larger, with the place of the body, a scale and what the colours mean.
/// Throws std::runtime_error where the file cannot be written.
void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path);

}  // namespace adit
