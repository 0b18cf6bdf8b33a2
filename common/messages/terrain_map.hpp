// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/terrain_t.hpp"

#include "common/messages/result.hpp"
#include "common/terrain/terrain_map.hpp"

namespace adit {

/// A terrain map with a run of its cells, as it goes onto channel TERRAIN; see terrain_tiles.hpp.
struct TerrainTile {
  static constexpr int kPiecesMax = 2000;      ///< of a map
  static constexpr int kCellsMax = 4'000'000;  ///< of a map
  static constexpr double kCornerMaxM = 1e5;   ///< to either side

  TerrainMap part;  ///< complete but for its cells, of which it has those from `first_cell` on
  int n_pieces = 1;
  int piece = 0;       ///< 0 to n_pieces − 1
  int first_cell = 0;  ///< row · columns + column
};

/// Lengths come back within 0.5 mm, slopes within 0.05 mrad; what is beyond 32.766 m, or 3.2766
/// rad, becomes that. A number that is not known stays so; a clearance stays infinite. Infinite
/// numbers of other kinds become the largest.
terrain_t to_message(const TerrainTile& tile);

/// Refused: an implausible time, a negative id, a pose or corner that cannot be, cells of no size,
/// more cells or pieces than plausible or a piece that is not one of them, more bytes than a piece
/// may have, cells that are not in the map, ground of an unknown kind, a negative count of points.
Result<TerrainTile> from_message(const terrain_t& message);

}  // namespace adit
