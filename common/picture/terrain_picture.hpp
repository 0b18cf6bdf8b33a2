// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/picture/legend.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// The layers of a terrain map.
enum class TerrainLayer {
  kCoefficient,  ///< roughness of the ground: bright is easy (the paper's figure 5b)
  kClearance,    ///< height of the roof above the ground: bright is high
  kKnowledge,    ///< whether the ground is observed, and why not
};

/// An image with one pixel per cell, x to the right and y up. Unknown ground has the colour of its
/// class in all layers.
RgbImage terrain_image(const TerrainMap& map, TerrainLayer layer = TerrainLayer::kCoefficient);

const char* title_of(TerrainLayer layer);
Legend legend_of(TerrainLayer layer);

/// Draws a layer of a terrain map as PNG, with the position of the body, a scale bar and a legend.
/// Throws std::runtime_error if the file cannot be written.
void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path,
                       TerrainLayer layer = TerrainLayer::kCoefficient);

}  // namespace adit
