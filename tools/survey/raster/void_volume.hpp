// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/section_outline.hpp"

namespace adit {

struct VoidVolumeParams {
  double hole_max_m = 1.0;     ///< unseen cells between void this far apart are void
  double wall_max_m = 0.5;     ///< thickness of a wall's relief in plan
  double common_sd_m = 0.004;  ///< error of ranges that all returns share
};

/// The space between floor, roof and walls.
struct VoidVolume {
  Measured area_m2;  ///< in plan
  Measured volume_m3;
  double filled_m2 = 0.0;  ///< part of the area where floor or roof was interpolated
};

/// Sums the columns of a grid. The returns of a wall are half in front of its middle: half of the
/// cells of wall beside void are void, of the same height. The standard deviation has the error of
/// ranges, which moves all surfaces outwards together, the scatter of the columns, and half of what
/// was interpolated.
VoidVolume void_volume(const ColumnGrid& grid, const VoidVolumeParams& params = {});

/// The same grid with what `void_volume` interpolates: unseen floor, roof and holes between void
/// columns. Their standard deviations stay unknown.
ColumnGrid with_holes_filled(const ColumnGrid& grid, const VoidVolumeParams& params = {});

}  // namespace adit
