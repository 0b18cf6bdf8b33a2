// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "adit/terrain_ready_t.hpp"
#include "adit/terrain_t.hpp"

#include "common/messages/fragments.hpp"
#include "common/messages/result.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// What describes a terrain map but for its cells; see TerrainMap.
struct TerrainHeader {
  std::int64_t utime = 0;
  std::int32_t id = 0;
  Pose2 T_odom_level;
  Eigen::Vector2d p_level_corner{0.0, 0.0};
  double cell_m = 0.1;
  int columns = 0;
  int rows = 0;

  friend bool operator==(const TerrainHeader&, const TerrainHeader&) = default;
};

/// A run of the cells of a terrain map, on channel TERRAIN.
struct TerrainFragment {
  static constexpr int kFragmentsMax = 2000;   ///< fragments of a map
  static constexpr int kCellsMax = 4'000'000;  ///< cells of a map

  TerrainHeader header;  ///< of the complete map
  int n_fragments = 1;
  int fragment = 0;                ///< 0 to n_fragments − 1
  int first_cell = 0;              ///< row · columns + column
  std::vector<TerrainCell> cells;  ///< from `first_cell` on, row by row
};

/// Lossy: lengths are restored within 0.5 mm, slopes within 0.05 mrad. Values beyond ±32.766 m or
/// ±3.2766 rad are clamped to that, also infinite ones; an unknown value (NaN) and an infinite
/// clearance are preserved.
terrain_t to_message(const TerrainFragment& fragment);

/// Rejects an implausible time, a negative id, an implausible pose or corner, an invalid cell size,
/// an implausible number of cells or fragments, an index out of range, a fragment that is too
/// large, cells outside the map, unknown ground, a negative count of points.
Result<TerrainFragment> from_message(const terrain_t& message);

/// Splits a terrain map deterministically into runs of cells that fit kFragmentBytes.
std::vector<TerrainFragment> split(const TerrainMap& map);

inline int reassembly_id(const TerrainFragment& /*fragment*/) { return 0; }
inline auto recency(const TerrainFragment& fragment) {
  return std::pair(fragment.header.utime, fragment.header.id);
}
inline bool same_header(const TerrainFragment& a, const TerrainFragment& b) {
  return a.header == b.header;
}
std::size_t bytes_in_memory(const TerrainFragment& fragment);
/// Nothing if a cell is missing or duplicated.
std::optional<TerrainMap> reassemble(const FragmentSet<TerrainFragment>& fragments);

/// Holds the newest map only.
using TerrainReassembler = Reassembler<TerrainFragment>;

terrain_ready_t to_message(const TerrainReady& ready);

/// Rejects an implausible time.
Result<TerrainReady> from_message(const terrain_ready_t& message);

}  // namespace adit
