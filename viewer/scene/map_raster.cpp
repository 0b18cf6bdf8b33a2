// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/map_raster.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

constexpr int kLocalMapCellsMax = 4'000'000;  // hundreds of metres at the finest resolution

std::uint8_t capped(unsigned count) {
  return static_cast<std::uint8_t>(
      std::min<unsigned>(count, std::numeric_limits<std::uint8_t>::max()));
}

/// Rounds towards negative infinity.
int halved(int cell) { return cell >= 0 ? cell / 2 : (cell - 1) / 2; }

}  // namespace

MapRaster rasterised(const OccupancyGrid& grid) {
  MapRaster raster{grid.resolution_m(), Grid2<MapRaster::Cell>(grid.observed_box())};
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    const OccupancyGrid::Counts counts = grid.counts(raster.cells.cell(i));
    if (counts.hits + counts.misses == 0) continue;
    raster.cells[i] = {capped(counts.hits), capped(counts.misses), Coverage::kLaser};
  }
  return raster;
}

MapRaster rasterised(const LocalMap& map, const Lasers& lasers, double cell_m) {
  OccupancyGrid grid({.resolution_m = cell_m, .cells_max = kLocalMapCellsMax});
  for (const LocalScan& scan : map.scans) {
    const LaserMount& mount = scan.channel == channels::kLaserRear ? lasers.rear : lasers.front;
    // False for a pose that is far outside; the other scans still show the place.
    static_cast<void>(grid.insert(scan.scan, scan.T_local_body * mount.T_body_laser));
  }
  return rasterised(grid);
}

MapRaster rasterised(const TerrainMap& terrain, double cell_m) {
  const CellBox& box = terrain.cells.box();
  const auto cell_of_corner = [&](const Eigen::Vector2i& corner) {
    return cell_of(terrain.p_level_corner + terrain.cell_m * corner.cast<double>(), cell_m);
  };
  MapRaster raster{cell_m,
                   Grid2<MapRaster::Cell>(CellBox{cell_of_corner(box.from),
                                                  cell_of_corner(box.to) + Eigen::Vector2i(1, 1)})};
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    const Eigen::Vector2i cell = terrain.cell_at(centre_of(raster.cells.cell(i), cell_m));
    if (terrain.cells.contains(cell) && terrain.cells.at(cell).ground == Ground::kObserved)
      raster.cells[i].coverage = Coverage::kScanned;
  }
  return raster;
}

MapRaster halved(const MapRaster& raster) {
  const CellBox& box = raster.cells.box();
  const auto corner = [](const Eigen::Vector2i& cell) {
    return Eigen::Vector2i(halved(cell.x()), halved(cell.y()));
  };
  MapRaster coarse{
      2.0 * raster.cell_m,
      Grid2<MapRaster::Cell>(CellBox{corner(box.from), corner(box.to) + Eigen::Vector2i(1, 1)})};
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    const MapRaster::Cell& fine = raster.cells[i];
    MapRaster::Cell& cell = coarse.cells.at(corner(raster.cells.cell(i)));
    cell.hits = capped(0U + cell.hits + fine.hits);
    cell.misses = capped(0U + cell.misses + fine.misses);
    cell.coverage = std::max(cell.coverage, fine.coverage);
  }
  return coarse;
}

}  // namespace adit
