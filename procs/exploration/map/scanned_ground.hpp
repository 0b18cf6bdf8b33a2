// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// What a 3D scan observed in a cell.
enum class ScannedCell : std::uint8_t {
  kUnknown,
  kGround,    ///< ground all around it, free of obstacles, under a roof that leaves room
  kRock,      ///< higher than any obstacle that leaves a frontier open
  kObstacle,  ///< lower than rock, but the vehicle cannot drive over it: a rail, rubble
};

/// The ground and the walls that a 3D scan observed, relative to a local map, so that they move
/// with the map. A level laser sees rising ground and falling roof as a wall; this tells them
/// apart.
struct ScannedGround {
  int local_map = 0;
  Pose2 T_local_level;
  Grid2<ScannedCell> cells;  ///< of the resolution of the known space, in level

  friend bool operator==(const ScannedGround& a, const ScannedGround& b) {
    return a.local_map == b.local_map && a.T_local_level == b.T_local_level &&
           a.cells.box() == b.cells.box() && std::ranges::equal(a.cells, b.cells);
  }
};

/// The cells of a terrain map, in level, for a vehicle.
Grid2<ScannedCell> scanned_cells(const TerrainMap& terrain, double resolution_m,
                                 const Vehicle& vehicle);

/// Conversion to a line of text and back, bit-exact. Empty for malformed text.
std::string to_text(const ScannedGround& ground);
std::optional<ScannedGround> scanned_ground_from_text(std::string_view text);

}  // namespace adit
