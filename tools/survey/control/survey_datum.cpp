// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/control/survey_datum.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/pose_graph/gaussian_field.hpp"
#include "tools/survey/control/height_adjustment.hpp"
#include "tools/survey/control/plan_network.hpp"

namespace adit {
namespace {

constexpr double kPlanGate = 13.82;    // chi-square, 2 degrees of freedom, 0.999
constexpr double kHeightGate = 10.83;  // 1 degree of freedom
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kEarthRadiusM = 6.371e6;
constexpr double kOriginStepM = 100.0;

/// The middle of the given coordinates: easting, northing, elevation; 0 for what none has.
Eigen::Vector3d middle_of(const std::vector<ControlPoint>& points) {
  Eigen::Vector3d sum(0.0, 0.0, 0.0);
  double in_plan = 0.0;
  double in_height = 0.0;
  for (const ControlPoint& point : points) {
    if (point.row.plan) {
      sum.head<2>() += *point.row.plan;
      in_plan += 1.0;
    }
    if (point.row.elevation_m) {
      sum.z() += *point.row.elevation_m;
      in_height += 1.0;
    }
  }
  return {sum.x() / std::max(1.0, in_plan), sum.y() / std::max(1.0, in_plan),
          sum.z() / std::max(1.0, in_height)};
}

std::string statement_of(const GridSystem& grid, const SurveyDatum& datum, std::size_t points,
                         bool has_heights) {
  std::string text = fmt::format("{}, by {} control points.", grid.name, points);
  if (grid.is_projected) {
    text += fmt::format(" Combined scale factor {:.6f}, grid convergence {:.4f}°.", datum.scale,
                        rad_to_deg(datum.convergence_rad));
  }
  text += has_heights ? " Elevations are those of the control."
                      : " Elevations are above the start of the mission.";
  return text;
}

/// Given elevations, each reduced to the origin of its local map.
std::vector<HeightObservation> height_observations(const std::vector<ControlPoint>& points) {
  std::vector<HeightObservation> observations;
  for (const ControlPoint& point : points) {
    if (!point.row.elevation_m) continue;
    observations.push_back({point.node, *point.row.elevation_m - point.p_local.z(),
                            point.row.sd_m * point.row.sd_m + point.z_sd_m * point.z_sd_m});
  }
  return observations;
}

/// Nothing without observations.
std::optional<HeightSolution> solve_heights(const SurveyInput& input,
                                            const SurveyGraph& free_network,
                                            const std::vector<ControlPoint>& points) {
  const std::vector<HeightObservation> observations = height_observations(points);
  if (observations.empty()) return std::nullopt;
  std::vector<std::size_t> observed;
  for (const HeightObservation& observation : observations) observed.push_back(observation.node);
  return adjust_heights(
      free_network, observations,
      height_covariances(input.map().full_map(), free_network, input.log_info(), observed));
}

SurveyGraph adjusted_graph(const SurveyGraph& free_network, const PlanNetwork& plan,
                           const std::optional<HeightSolution>& heights) {
  std::vector<SurveyGraph::Node> nodes = free_network.nodes();
  std::vector<int> ids;
  for (const SurveyGraph::Node& node : nodes) ids.push_back(node.id);
  const std::vector<Eigen::Matrix3d> covariances = plan.covariances(ids);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].T_survey_local.plan = plan.T_survey_local(nodes[i].id);
    nodes[i].covariance = covariances[i];
    if (!heights) continue;
    nodes[i].T_survey_local.z_m = heights->z_m[static_cast<Eigen::Index>(i)];
    nodes[i].z_variance = heights->variance[static_cast<Eigen::Index>(i)];
  }
  return SurveyGraph(std::move(nodes));
}

std::vector<ControlResidual> residuals_of(const std::vector<ControlPoint>& points,
                                          const MinePlane& plane, const PlanNetwork& network,
                                          const std::optional<HeightSolution>& heights) {
  const std::vector<PlanNetwork::Residual> in_plan = network.residuals();
  auto plan = in_plan.begin();
  Eigen::Index height = 0;
  std::vector<ControlResidual> residuals;
  for (const ControlPoint& point : points) {
    ControlResidual residual{point.row.name,
                             Eigen::Vector3d::Constant(kUnknown),
                             Eigen::Vector3d::Constant(kUnknown),
                             {},
                             {}};
    if (point.row.plan) {
      residual.given.head<2>() = *point.row.plan;
      residual.residual.head<2>() =
          plane.scale * (plan->adjusted - plane.from_grid(*point.row.plan));
      residual.plan_test = plan->test;
      ++plan;
    }
    if (point.row.elevation_m) {
      residual.given.z() = *point.row.elevation_m;
      residual.residual.z() = heights->residual[height];
      if (std::isfinite(heights->test[height])) residual.z_test = heights->test[height];
      ++height;
    }
    residuals.push_back(std::move(residual));
  }
  return residuals;
}

std::string cell(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string();
}

}  // namespace

bool ControlResidual::is_suspect() const {
  return plan_test.value_or(0.0) > kPlanGate || z_test.value_or(0.0) > kHeightGate;
}

SurveyDatum free_datum(const SurveyInput& input) {
  return {SurveyGraph::free_network(input.map().full_map()), SurveyFrame::local()};
}

SurveyDatum controlled_datum(const SurveyInput& input, const SurveyGraph& free_network,
                             const std::vector<ControlPoint>& points, const GridSystem& grid) {
  const Eigen::Vector3d middle = middle_of(points);
  MinePlane plane;
  plane.origin = kOriginStepM * (middle.head<2>() / kOriginStepM).array().round().matrix();
  const auto factors = grid_factors(grid, middle.head<2>());
  if (factors) plane.scale = factors->scale * kEarthRadiusM / (kEarthRadiusM + middle.z());
  const PlanNetwork plan(points, plane, free_network, input.map().full_map().graph);
  const auto heights = solve_heights(input, free_network, points);

  SurveyDatum datum{adjusted_graph(free_network, plan, heights), SurveyFrame::local(),
                    residuals_of(points, plane, plan, heights), plane.scale,
                    factors ? factors->convergence_rad : 0.0};
  datum.frame =
      SurveyFrame({plane.origin.x(), plane.origin.y(), 0.0}, plane.scale, grid.wkt, grid.crs_name,
                  statement_of(grid, datum, points.size(), heights.has_value()));
  return datum;
}

std::string control_table(const std::vector<ControlResidual>& residuals) {
  std::string table =
      "name,easting_m,northing_m,elevation_m,residual_easting_m,residual_northing_m,"
      "residual_elevation_m,plan_test,elevation_test,suspect\n";
  for (const ControlResidual& point : residuals) {
    fmt::format_to(std::back_inserter(table), "{},{},{},{},{},{},{},{},{},{}\n", point.name,
                   cell(point.given.x(), 3), cell(point.given.y(), 3), cell(point.given.z(), 3),
                   cell(point.residual.x(), 3), cell(point.residual.y(), 3),
                   cell(point.residual.z(), 3), cell(point.plan_test.value_or(kUnknown), 1),
                   cell(point.z_test.value_or(kUnknown), 1), point.is_suspect() ? "yes" : "no");
  }
  return table;
}

}  // namespace adit
