// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/raster/elevation_rasters.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace adit {
namespace {

/// A raster over the cells of a box, without bands.
Raster raster_over(const CellBox& box, double cell_m, const SurveyFrame& frame) {
  Raster raster;
  raster.columns = box.size().x();
  raster.rows = box.size().y();
  raster.cell_m = frame.scale() * cell_m;
  const Eigen::Vector2d corner = cell_m * Eigen::Vector2d(box.from.x(), box.to.y());
  raster.north_west = frame.in_grid(corner);
  return raster;
}

/// A band with the value of each cell, from the north.
template <class ValueOf>
RasterBand band_of(std::string description, std::string unit, const CellBox& box, ValueOf value) {
  RasterBand band{std::move(description), std::move(unit), {}};
  band.values.reserve(box.count());
  for (int y = box.to.y() - 1; y >= box.from.y(); --y) {
    for (int x = box.from.x(); x < box.to.x(); ++x)
      band.values.push_back(static_cast<float>(value(Eigen::Vector2i(x, y))));
  }
  return band;
}

template <class ValueOf>
Raster column_raster(const ColumnGrid& grid, const SurveyFrame& frame, std::string description,
                     ValueOf value) {
  const CellBox& box = grid.columns.box();
  Raster raster = raster_over(box, grid.cell_m, frame);
  raster.bands.push_back(
      band_of(std::move(description), "m", box,
              [&](const Eigen::Vector2i& cell) { return value(grid.columns.at(cell)); }));
  return raster;
}

}  // namespace

Raster floor_raster(const ColumnGrid& grid, const SurveyFrame& frame) {
  const double z_m = frame.origin().z();
  return column_raster(grid, frame, "floor elevation",
                       [z_m](const SurveyColumn& column) { return column.floor_m + z_m; });
}

Raster roof_raster(const ColumnGrid& grid, const SurveyFrame& frame) {
  const double z_m = frame.origin().z();
  return column_raster(grid, frame, "roof elevation",
                       [z_m](const SurveyColumn& column) { return column.roof_m + z_m; });
}

Raster height_raster(const ColumnGrid& grid, const SurveyFrame& frame) {
  return column_raster(grid, frame, "height from floor to roof",
                       [](const SurveyColumn& column) { return column.height_m(); });
}

Raster deviation_raster(const ColumnGrid& grid, const SurveyFrame& frame) {
  Raster raster = column_raster(grid, frame, "standard deviation of floor elevation",
                                [](const SurveyColumn& column) { return column.floor_sd_m; });
  const CellBox& box = grid.columns.box();
  raster.bands.push_back(
      band_of("standard deviation of roof elevation", "m", box,
              [&](const Eigen::Vector2i& cell) { return grid.columns.at(cell).roof_sd_m; }));
  raster.bands.push_back(
      band_of("standard deviation in plan, worst direction", "m", box,
              [&](const Eigen::Vector2i& cell) { return grid.columns.at(cell).plan_sd_m; }));
  return raster;
}

Raster occupancy_raster(const OccupancyGrid& grid, const SurveyFrame& frame) {
  const CellBox box = grid.observed_box();
  Raster raster = raster_over(box, grid.resolution_m(), frame);
  raster.bands.push_back(
      band_of("share of scans that were reflected", "", box, [&](const Eigen::Vector2i& cell) {
        return grid.state(cell) == CellState::kUnknown ? std::numeric_limits<double>::quiet_NaN()
                                                       : grid.occupancy(cell);
      }));
  return raster;
}

}  // namespace adit
