// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/raster/column_grid.hpp"

namespace adit {

/// The line between void and what is not, in survey: the walls at the height of the workings, and
/// ends of what is seen.
struct VoidOutline {
  std::vector<Eigen::Vector2d> points;  ///< p_survey; closed lines repeat the first point
  bool is_pillar = false;               ///< closed around rock within the workings
  double length_m = 0.0;
  double area_m2 = 0.0;  ///< enclosed
  double z_m = 0.0;      ///< height of the floor beside it
};

/// Outlines of the void of a grid without gaps, in the middle of the relief of its walls; those
/// shorter than 1 m are left out.
std::vector<VoidOutline> void_outlines(const ColumnGrid& filled);

/// A line of equal elevation of the floor.
struct FloorContour {
  double elevation_m = 0.0;                  ///< in the grid
  std::vector<Eigen::Vector2d> points_grid;  ///< easting, northing
};

/// Contours of the floor each 0.25 m, of 2 m length and more.
std::vector<FloorContour> floor_contour_lines(const ColumnGrid& columns, const SurveyFrame& frame);

}  // namespace adit
