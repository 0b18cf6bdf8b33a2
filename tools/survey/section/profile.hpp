// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/raster/column_grid.hpp"
#include "tools/survey/section/cross_section.hpp"

namespace adit {

/// Floor and roof at a place of a centre line; NaN where unseen.
struct ProfilePoint {
  double chainage_m = 0.0;
  Eigen::Vector2d p_survey{0.0, 0.0};
  Measured floor_m;  ///< heights in survey
  Measured roof_m;
};

/// The longitudinal profile of a tunnel.
struct Profile {
  int tunnel = 0;
  std::vector<ProfilePoint> points;
};

/// Floor and roof each `every_m` along the lines: medians of the columns around.
std::vector<Profile> profiles(const std::vector<CentreLine>& lines, const ColumnGrid& columns,
                              double every_m);

/// All profiles as comma-separated values, a line for each point. What is unseen is empty.
std::string profile_table(const std::vector<Profile>& profiles, const SurveyFrame& frame);

}  // namespace adit
