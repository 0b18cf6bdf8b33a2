// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/pose_graph/map_graph.hpp"
#include "tools/survey/control/control_points.hpp"
#include "tools/survey/frame/survey_graph.hpp"

namespace adit {

/// The plane of the mine: the grid at its origin, with the lengths of the mine.
struct MinePlane {
  Eigen::Vector2d origin{0.0, 0.0};  ///< in the grid
  double scale = 1.0;                ///< lengths in the grid over lengths in the mine

  [[nodiscard]] Eigen::Vector2d from_grid(const Eigen::Vector2d& p) const {
    return (p - origin) / scale;
  }
};

/// The pose graph tied to the grid by control points, adjusted by least squares over all
/// constraints (common/pose_graph). A point is a node of its own, tied to its local map by a pose
/// whose heading means nothing, and to the grid by its position.
class PlanNetwork {
 public:
  /// Throws std::runtime_error if the constraints do not determine all poses.
  PlanNetwork(const std::vector<ControlPoint>& points, const MinePlane& plane,
              const SurveyGraph& free_network, const MapGraph& graph);

  /// Pose of a local map, and its covariance (SurveyGraph::Node::covariance).
  [[nodiscard]] const Pose2& T_survey_local(int id) const;
  [[nodiscard]] std::vector<Eigen::Matrix3d> covariances(const std::vector<int>& ids) const;

  struct Residual {
    Eigen::Vector2d adjusted{0.0, 0.0};  ///< in the plane of the mine
    std::optional<double> test;          ///< see ControlResidual::plan_test
  };
  /// Of the points with a place in plan, in their order.
  [[nodiscard]] std::vector<Residual> residuals() const;

 private:
  void add(const ControlPoint& point, const MinePlane& plane, const SurveyGraph& free_network);

  PoseGraph network_;
  std::vector<PoseConstraint> ties_;  // to the grid
};

}  // namespace adit
