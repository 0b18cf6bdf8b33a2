// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/grid/occupancy_grid.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/raster/column_grid.hpp"

namespace adit {

/// Floor and roof elevation and the height between them, where both are seen: one band each.
Raster floor_raster(const ColumnGrid& grid, const SurveyFrame& frame);
Raster roof_raster(const ColumnGrid& grid, const SurveyFrame& frame);
Raster height_raster(const ColumnGrid& grid, const SurveyFrame& frame);
/// Standard deviations: of floor elevation, of roof elevation, of the place in plan.
Raster deviation_raster(const ColumnGrid& grid, const SurveyFrame& frame);

/// Share of scans of the level lasers that were reflected by each cell, 0 to 1.
Raster occupancy_raster(const OccupancyGrid& grid, const SurveyFrame& frame);

}  // namespace adit
