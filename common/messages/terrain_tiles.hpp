// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "common/messages/newest_assembler.hpp"
#include "common/messages/terrain_map.hpp"

namespace adit {

/// Divides a terrain map, always in the same way, into runs of cells that fit kPieceBytes.
std::vector<TerrainTile> divide(const TerrainMap& map);

inline auto age(const TerrainTile& tile) { return std::pair(tile.part.utime, tile.part.id); }
bool same_head(const TerrainTile& a, const TerrainTile& b);
std::size_t bytes_in_memory(const TerrainTile& tile);
/// Nothing where a cell is missing or there twice.
std::optional<TerrainMap> join(const PieceSet<TerrainTile>& tiles);

using TerrainAssembler = NewestAssembler<TerrainTile>;

}  // namespace adit
