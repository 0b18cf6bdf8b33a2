// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/local_map.hpp"
#include "common/types/terrain_map.hpp"

namespace adit {

/// How well a place is known, better with a greater value: the field coverage of /map.
enum class Coverage : std::uint8_t { kNone = 0, kLaser = 1, kScanned = 2, kDriven = 3 };

/// What one local map or 3D scan shows of each cell, in its own frame.
struct MapRaster {
  struct Cell {
    std::uint8_t hits = 0;    ///< scans that observed it as reflecting, up to 255
    std::uint8_t misses = 0;  ///< and as transparent
    Coverage coverage = Coverage::kNone;
  };

  double cell_m = 0.1;
  Grid2<Cell> cells = {};

  [[nodiscard]] std::size_t bytes() const { return cells.size() * sizeof(Cell); }
};

/// What a grid shows, in its frame; counts of one cell are limited to 255.
MapRaster rasterised(const OccupancyGrid& grid);
/// The scans of a local map, in its frame.
MapRaster rasterised(const LocalMap& map, const Lasers& lasers, double cell_m);
/// The ground that a 3D scan observed, in the frame level.
MapRaster rasterised(const TerrainMap& terrain, double cell_m);
/// The same in cells of twice the size.
MapRaster halved(const MapRaster& raster);

}  // namespace adit
