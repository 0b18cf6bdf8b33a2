// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "common/picture/terrain_layer.hpp"

namespace adit {

/// Draws a layer of a terrain map as PNG, with the place of the body, a scale and what the colours
/// mean. Throws std::runtime_error where the file cannot be written.
void write_terrain_png(const TerrainMap& map, const std::filesystem::path& path,
                       TerrainLayer layer = TerrainLayer::kCoefficient);

}  // namespace adit
