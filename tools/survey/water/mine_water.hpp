// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "tools/survey/files/vector_layer.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/plan/hazard_marks.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/section_outline.hpp"
#include "tools/survey/water/flood.hpp"

namespace adit {

/// A body of water in survey, with what is uncertain of it.
struct SurveyedWater {
  enum class Kind : std::uint8_t {
    kSeen,     ///< stands there: the lasers get no return from it, so its depth is unknown (NaN)
    kHollow,   ///< a hollow of the floor, filled to where it spills
    kFlooded,  ///< at the level that was asked for
  };
  Kind kind = Kind::kHollow;
  WaterBody body;
  double level_sd_m = 0.0;
  Measured area_m2 = {};
  Measured volume_m3 = {};
  Measured depth_m = {};
};

const char* name_of(SurveyedWater::Kind kind);

/// The floor with the ends of what was seen as outlets: void beside columns that are neither void
/// nor wall, over `outlet_min_m` and more; shadows behind relief are narrower. `free_space` knows
/// walls that no 3D scan saw; may be null.
FloodGround flood_ground(const ColumnGrid& filled, const OccupancyGrid* free_space,
                         double outlet_min_m = 0.8);

/// Water that stands in the mine, hollows that it would fill, and what is flooded at `level_m` (in
/// survey; nothing: not asked for). `columns`: as seen; `filled`: without gaps. Standing water is
/// the part without returns of the hazards "water"; its level is that of the floor at its shore.
/// The standard deviations of the others are from the same water with the level raised and lowered
/// by that of the floor; a hollow keeps its depth, of which both ends were measured.
std::vector<SurveyedWater> mine_water(const ColumnGrid& columns, const ColumnGrid& filled,
                                      const OccupancyGrid* free_space,
                                      const std::vector<HazardMark>& hazards,
                                      std::optional<double> level_m);

/// Outlines of the bodies as the layer `water`, and the bodies as comma-separated values; in the
/// grid.
VectorLayer water_layer(const std::vector<SurveyedWater>& bodies, const SurveyFrame& frame,
                        double cell_m);
std::string water_table(const std::vector<SurveyedWater>& bodies, const SurveyFrame& frame);

}  // namespace adit
