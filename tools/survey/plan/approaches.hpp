// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/files/given_lines.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/section_outline.hpp"

namespace adit {

/// How near the workings come to a line, an area or a point of another survey, in plan.
struct CloseApproach {
  std::string layer;
  std::string name;
  /// From the nearest wall, in the lengths of the mine; its standard deviation has the places of
  /// the workings, not that of what was given. 0 where they meet.
  Measured distance_m;
  Eigen::Vector2d p_wall{0.0, 0.0};   ///< p_survey
  Eigen::Vector2d p_given{0.0, 0.0};  ///< p_survey
  bool within = false;                ///< whether the wall there lies within the area

  /// Whether they may meet (95 %).
  [[nodiscard]] bool may_meet() const { return distance_m.value <= 1.96 * distance_m.sd; }
};

/// One for each given line, the nearest first. `filled`: columns without gaps. Empty without
/// workings.
std::vector<CloseApproach> approaches_to(const std::vector<GivenLine>& given,
                                         const ColumnGrid& filled, const SurveyGraph& graph,
                                         const SurveyFrame& frame);

/// As comma-separated values, places in the grid.
std::string approach_table(const std::vector<CloseApproach>& approaches, const SurveyFrame& frame);

}  // namespace adit
