// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/terrain_tiles.hpp"

#include <algorithm>
#include <cstdint>

namespace adit {
namespace {

// On the wire.
constexpr std::size_t kHeadBytes = 128;
constexpr std::size_t kCellBytes = 1 + 8 * sizeof(std::int16_t);
constexpr std::size_t kCellsOfTile = (kPieceBytes - kHeadBytes) / kCellBytes;

TerrainMap head_of(const TerrainMap& map) {
  return {map.utime,  map.id,      map.T_odom_level, map.p_level_corner,
          map.cell_m, map.columns, map.rows,         {}};
}

}  // namespace

std::vector<TerrainTile> divide(const TerrainMap& map) {
  const std::size_t n = map.cells.size();
  const std::size_t n_tiles = std::max<std::size_t>(1, (n + kCellsOfTile - 1) / kCellsOfTile);
  std::vector<TerrainTile> tiles;
  for (std::size_t i = 0; i < n_tiles; ++i) {
    const std::size_t first = i * kCellsOfTile;
    const std::size_t end = std::min(n, first + kCellsOfTile);
    TerrainTile tile{head_of(map), static_cast<int>(n_tiles), static_cast<int>(i),
                     static_cast<int>(first)};
    tile.part.cells.assign(map.cells.begin() + static_cast<std::ptrdiff_t>(first),
                           map.cells.begin() + static_cast<std::ptrdiff_t>(end));
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

bool same_head(const TerrainTile& a, const TerrainTile& b) {
  return a.part.T_odom_level == b.part.T_odom_level &&
         a.part.p_level_corner == b.part.p_level_corner && a.part.cell_m == b.part.cell_m &&
         a.part.columns == b.part.columns && a.part.rows == b.part.rows;
}

std::size_t bytes_in_memory(const TerrainTile& tile) {
  return sizeof(TerrainCell) * tile.part.cells.size();
}

std::optional<TerrainMap> join(const PieceSet<TerrainTile>& tiles) {
  TerrainMap map = head_of(tiles.pieces().front()->part);
  for (const auto& tile : tiles.pieces()) {
    if (static_cast<std::size_t>(tile->first_cell) != map.cells.size()) return std::nullopt;
    map.cells.insert(map.cells.end(), tile->part.cells.begin(), tile->part.cells.end());
  }
  const auto n = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  if (map.cells.size() != n) return std::nullopt;
  return map;
}

}  // namespace adit
