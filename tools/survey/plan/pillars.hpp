// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/plan/outlines.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/section_outline.hpp"

namespace adit {

/// Width up to which a gap is no tunnel.
inline constexpr double kPassageM = 2.0;

/// Rock within the workings, around which the robot has been or seen.
struct Pillar {
  VoidOutline outline;
  Measured area_m2;
  double width_m = 0.0;   ///< diameter of the largest circle in it
  double height_m = 0.0;  ///< of the workings around it, median; NaN where floor or roof is unseen
  double unseen_m = 0.0;  ///< of its outline: no wall was seen there
  double gap_m = 0.0;     ///< the longest stretch of that

  /// Whether no working can begin in its outline. Else it is this large at most.
  [[nodiscard]] bool is_closed() const { return gap_m <= kPassageM; }

  /// A width of less than its height: such pillars carry little (Zipf, "Toward pillar design to
  /// prevent collapse of room-and-pillar mines", SME 2001).
  [[nodiscard]] bool is_slender() const { return width_m < height_m; }
};

/// What was extracted of the seam where pillars stand.
struct Extraction {
  double pillars_m2 = 0.0;
  /// Area of void over that of void and pillars; NaN without pillars. Ribs, which were not
  /// seen from all around, are not rock of the workings: an upper bound.
  Measured ratio;
};

/// Pillars of at least 1 m² and 0.3 m of width; the smallest width first. Outlines of which more
/// than half was not seen are left out. `filled`: columns without gaps.
std::vector<Pillar> pillars_of(const ColumnGrid& filled);

Extraction extraction(const std::vector<Pillar>& pillars, const Measured& void_area_m2);

/// As comma-separated values, places in the grid.
std::string pillar_table(const std::vector<Pillar>& pillars, const SurveyFrame& frame);

}  // namespace adit
