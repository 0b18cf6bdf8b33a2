// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/map_graph.hpp"
#include "tools/survey/frame/registered_cloud.hpp"
#include "tools/survey/frame/survey_frame.hpp"

namespace adit {

/// A loop of the traverse: a loop closure and the traverse between its local maps.
struct TraverseLoop {
  int from = 0;  ///< local maps, the older one first
  int to = 0;
  double length_m = 0.0;  ///< of the traverse between them
  /// By how much the traverse, followed from `from` to `to` without any loop closure, misses where
  /// the loop closure puts `to`.
  double misclosure_m = 0.0;
  double misclosure_rad = 0.0;
  /// Of that misclosure by what the traverse and the loop closure state: chi-square with three
  /// degrees of freedom.
  double chi2 = 0.0;
};

/// The loops of the loop closures in force, the worst chi-square first. Those without a traverse of
/// consecutive local maps between their ends (another session) are left out.
std::vector<TraverseLoop> traverse_loops(const MapGraph& graph);

/// What contributes to the accuracy of a coordinate; standard deviations [m] in the worst direction
/// in plan, and of the elevation. NaN where it says nothing.
struct BudgetRow {
  std::string source;
  double plan_sd_m = 0.0;
  double z_sd_m = 0.0;
};

/// The rows of the budget: range of the lasers, levelling at the median distance of returns,
/// matching along the open traverse to its most uncertain station, and closing (with control, too)
/// at the most uncertain one of the adjusted survey; then the point that all of these make.
std::vector<BudgetRow> accuracy_budget(const MapGraph& graph, const RegisteredCloud& cloud);

/// Semi-axes of the ellipse that holds a station with 95 %, and the bearing of the larger one.
struct Ellipse95 {
  double major_m = 0.0;
  double minor_m = 0.0;
  Eigen::Vector2d major_axis{1.0, 0.0};  ///< unit vector in survey
};

Ellipse95 ellipse_95(const SurveyGraph::Node& station);

/// The loops as comma-separated values.
std::string loop_table(const std::vector<TraverseLoop>& loops);

}  // namespace adit
