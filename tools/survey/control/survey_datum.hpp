// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/survey/control/control_points.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/input/survey_input.hpp"

namespace adit {

/// A control point after the adjustment.
struct ControlResidual {
  std::string name;
  Eigen::Vector3d given{0.0, 0.0, 0.0};     ///< grid; NaN where nothing is given
  Eigen::Vector3d residual{0.0, 0.0, 0.0};  ///< adjusted less given, grid; NaN as above
  /// How much the objective falls without the point: chi-square with two degrees of freedom in plan
  /// and one in height, if it is right (Baarda 1968: data snooping). Empty if the others do not
  /// determine the survey.
  std::optional<double> plan_test;
  std::optional<double> z_test;

  /// Beyond 99.9 %: a blunder of this point or of one that the others lean on.
  [[nodiscard]] bool is_suspect() const;
};

/// What ties a survey to its coordinate system: the local maps in it.
struct SurveyDatum {
  SurveyGraph graph;
  SurveyFrame frame;
  std::vector<ControlResidual> residuals = {};  ///< of each control point
  double scale = 1.0;            ///< combined: lengths in the grid over lengths in the mine
  double convergence_rad = 0.0;  ///< of grid north, clockwise from true north
};

/// The free network of a mission, in the local grid.
SurveyDatum free_datum(const SurveyInput& input);

/// Least squares over the whole pose graph with the control points as observations, from which
/// every local map gets its place and covariance in the grid: PlanNetwork in plan, adjust_heights
/// in height. Without any elevation heights stay those above the start. Throws std::runtime_error
/// if points and graph do not determine the survey.
SurveyDatum controlled_datum(const SurveyInput& input, const SurveyGraph& free_network,
                             const std::vector<ControlPoint>& points, const GridSystem& grid);

/// The residuals as comma-separated values, a line for each point.
std::string control_table(const std::vector<ControlResidual>& residuals);

}  // namespace adit
