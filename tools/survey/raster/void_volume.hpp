// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/grid/occupancy_grid.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/section_outline.hpp"

namespace adit {

struct VoidVolumeParams {
  double fill_max_m = 1.5;     ///< from a column whose floor and roof are seen, for one where not
  double wall_max_m = 0.5;     ///< thickness of a wall's relief in plan
  double common_sd_m = 0.004;  ///< error of ranges that all returns share
};

/// The space between floor, roof and walls.
struct VoidVolume {
  Measured area_m2;  ///< in plan
  Measured volume_m3;
  double filled_m2 = 0.0;  ///< part of the area where floor or roof was interpolated
};

/// A grid without gaps: the columns of void whose floor or roof is unseen, and unseen columns where
/// the level lasers saw free space, get what they lack from the nearest complete column. The
/// standard deviations of these values stay unknown. `free_space` may be null.
ColumnGrid with_gaps_filled(const ColumnGrid& grid, const OccupancyGrid* free_space,
                            const VoidVolumeParams& params = {});

/// Sums the columns of a grid; `filled`: the same without gaps. The returns of a wall are half in
/// front of its middle: half of the cells of wall beside void are void, of the same height. The
/// standard deviation has the error of ranges, which moves all surfaces outwards together, the
/// scatter of the cells of wall, and a tenth of what was filled.
VoidVolume void_volume(const ColumnGrid& grid, const ColumnGrid& filled,
                       const VoidVolumeParams& params = {});

}  // namespace adit
