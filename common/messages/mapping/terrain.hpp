// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "adit/terrain_ready_t.hpp"
#include "adit/terrain_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// A terrain map with a run of its cells, as it goes onto channel TERRAIN; see terrain_tiles.hpp.
struct TerrainFragment {
  static constexpr int kFragmentsMax = 2000;   ///< of a map
  static constexpr int kCellsMax = 4'000'000;  ///< of a map
  static constexpr double kCornerMaxM = 1e5;   ///< to either side

  TerrainMap part;  ///< complete but for its cells, of which it has those from `first_cell` on
  int n_fragments = 1;
  int fragment = 0;    ///< 0 to n_fragments − 1
  int first_cell = 0;  ///< row · columns + column
};

/// Lengths come back within 0.5 mm, slopes within 0.05 mrad; what is beyond 32.766 m, or 3.2766
/// rad, becomes that. A number that is not known stays so; a clearance stays infinite. Infinite
/// numbers of other kinds become the largest.
terrain_t to_message(const TerrainFragment& fragment);

/// Refused: an implausible time, a negative id, a pose or corner that cannot be, cells of no size,
/// more cells or pieces than plausible or a piece that is not one of them, more bytes than a piece
/// may have, cells that are not in the map, ground of an unknown kind, a negative count of points.
Result<TerrainFragment> from_message(const terrain_t& message);

/// Divides a terrain map, always in the same way, into runs of cells that fit kFragmentBytes.
std::vector<TerrainFragment> split(const TerrainMap& map);

inline auto recency(const TerrainFragment& fragment) {
  return std::pair(fragment.part.utime, fragment.part.id);
}
bool same_header(const TerrainFragment& a, const TerrainFragment& b);
std::size_t bytes_in_memory(const TerrainFragment& fragment);
/// Nothing where a cell is missing or there twice.
std::optional<TerrainMap> reassemble(const FragmentSet<TerrainFragment>& fragments);

using TerrainReassembler = LatestReassembler<TerrainFragment>;

terrain_ready_t to_message(const TerrainReady& ready);

/// Refused: an implausible time.
Result<TerrainReady> from_message(const terrain_ready_t& message);

}  // namespace adit
