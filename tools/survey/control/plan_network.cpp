// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/control/plan_network.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/pose_graph/gaussian_field.hpp"
#include "common/pose_graph/optimize.hpp"

namespace adit {
namespace {

constexpr double kTargetSdM = 0.01;     // of a point in the frame of its local map
constexpr double kTargetHeading = 1e6;  // information of a heading that means nothing

// Node 0 is the grid, then the local maps by id, then the control points.
int node_of_map(int id) { return id + 1; }

}  // namespace

PlanNetwork::PlanNetwork(const std::vector<ControlPoint>& points, const MinePlane& plane,
                         const SurveyGraph& free_network, const MapGraph& graph) {
  std::vector<Eigen::Vector2d> from;
  std::vector<Eigen::Vector2d> to;
  for (const ControlPoint& point : points) {
    if (!point.row.plan) continue;
    from.emplace_back(point.p_map.head<2>());
    to.push_back(plane.from_grid(*point.row.plan));
  }
  const Pose2 T_survey_map = fit_plan(from, to).T_to_from;
  network_.poses.push_back({});
  for (const Pose2& T_map_local : graph.poses) network_.poses.push_back(T_survey_map * T_map_local);
  for (const MapConstraint& constraint : graph.constraints) {
    PoseConstraint moved = constraint.measured;
    moved.from = node_of_map(moved.from);
    moved.to = node_of_map(moved.to);
    network_.constraints.push_back(moved);
  }
  for (const ControlPoint& point : points) add(point, plane, free_network);
  const OptimizeResult result = optimize(network_, {.rotation_initialization = false});
  if (!result.converged) {
    throw std::runtime_error(fmt::format("the control points do not determine the survey: {}",
                                         text(result.reason, result.node)));
  }
}

void PlanNetwork::add(const ControlPoint& point, const MinePlane& plane,
                      const SurveyGraph& free_network) {
  if (!point.row.plan) return;
  const int map = node_of_map(free_network.nodes()[point.node].id);
  const int target = static_cast<int>(network_.poses.size());
  const Pose2 T_local_target{point.p_local.x(), point.p_local.y(), 0.0};
  network_.poses.push_back(network_.poses[static_cast<std::size_t>(map)] * T_local_target);
  const double found = 1.0 / (kTargetSdM * kTargetSdM);
  network_.constraints.push_back(
      {map, target, T_local_target, Eigen::Vector3d(found, found, kTargetHeading).asDiagonal()});
  const Eigen::Vector2d p = plane.from_grid(*point.row.plan);
  const double given = 1.0 / (point.row.sd_m * point.row.sd_m);
  ties_.push_back(
      {0, target, {p.x(), p.y(), 0.0}, Eigen::Vector3d(given, given, 0.0).asDiagonal()});
  network_.constraints.push_back(ties_.back());
}

const Pose2& PlanNetwork::T_survey_local(int id) const {
  return network_.poses[static_cast<std::size_t>(node_of_map(id))];
}

std::vector<Eigen::Matrix3d> PlanNetwork::covariances(const std::vector<int>& ids) const {
  const GaussianField field(network_);
  std::vector<Eigen::Matrix3d> covariances;
  covariances.reserve(ids.size());
  for (const int id : ids) covariances.push_back(field.relative_covariance(0, node_of_map(id)));
  return covariances;
}

/// With two points, one alone does not determine the bearing.
std::vector<PlanNetwork::Residual> PlanNetwork::residuals() const {
  std::vector<GaussianField::LeaveOneOut> without;
  if (ties_.size() > 2)
    without = GaussianField(network_).leave_one_out(ties_, network_.constraints.front());
  std::vector<Residual> residuals;
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    Residual residual;
    residual.adjusted = network_.poses[static_cast<std::size_t>(ties_[i].to)].translation();
    if (i < without.size() && std::isfinite(without[i].objective_decrease))
      residual.test = without[i].objective_decrease;
    residuals.push_back(residual);
  }
  return residuals;
}

}  // namespace adit
