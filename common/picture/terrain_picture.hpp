// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/picture/legend.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// What of a terrain map is drawn.
enum class TerrainLayer {
  kCoefficient,  ///< how hard the ground is to pass: bright is easy (the paper's figure 5b)
  kClearance,    ///< how high the roof is above it: bright is high
  kKnowledge,    ///< what is known of it, and why not
};

/// A pixel for each cell, x to the right and y up. Unknown ground has the colour of its class in
/// all layers.
RgbImage terrain_image(const TerrainMap& map, TerrainLayer layer = TerrainLayer::kCoefficient);

const char* title_of(TerrainLayer layer);
Legend legend_of(TerrainLayer layer);

/// Draws a layer of a terrain map as PNG, with the place of the body, a scale and what the colours
/// mean. Throws std::runtime_error where the file cannot be written.
void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path,
                       TerrainLayer layer = TerrainLayer::kCoefficient);

}  // namespace adit
