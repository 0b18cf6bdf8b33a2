// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "tools/map/full_map.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/survey/frame/survey_graph.hpp"

namespace adit {

/// A given elevation of the origin of a local map.
struct HeightObservation {
  std::size_t node = 0;  ///< of SurveyGraph
  double z_m = 0.0;
  double variance = 0.0;
};

/// Heights of the local maps with given elevations.
struct HeightSolution {
  Eigen::VectorXd z_m;       ///< of each node, in the grid
  Eigen::VectorXd variance;  ///< of it [m²]
  Eigen::VectorXd residual;  ///< of each observation: adjusted less given [m]
  Eigen::VectorXd test;      ///< see ControlResidual::z_test; NaN for a single observation
};

/// Least squares of the heights of a free network and at least one given elevation, with the height
/// of map in the grid as an unknown without prior (universal kriging: Cressie, "Statistics for
/// spatial data", 1993, section 3.4). `with_observed`: covariance of the height of each node (rows)
/// with that of the node of each observation (columns).
HeightSolution adjust_heights(const SurveyGraph& free_network,
                              const std::vector<HeightObservation>& observations,
                              const Eigen::MatrixXd& with_observed);

/// Covariances of the heights of all nodes with those of the given ones, relative to the first
/// local map. Correlations are those of the height field that mapping builds of the same local maps
/// and loop closures (MapHeights); deviations are those of the pose graph.
Eigen::MatrixXd height_covariances(const FullMap& map, const SurveyGraph& free_network,
                                   const LogInfo& log_info,
                                   const std::vector<std::size_t>& observed);

}  // namespace adit
