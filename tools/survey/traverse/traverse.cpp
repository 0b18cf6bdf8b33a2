// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/traverse/traverse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "common/pose_graph/gaussian_field.hpp"
#include "common/pose_graph/map_correction.hpp"

namespace adit {
namespace {

constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();
constexpr double kEllipse95 = 2.447747;   // chi-square with two degrees of freedom
constexpr std::size_t kSampleEvery = 97;  // of the points whose distance is looked at

/// The traverse as measured: each local map by the sequential constraint from the one before.
class OpenTraverse {
 public:
  explicit OpenTraverse(const MapGraph& graph) : step_to_(graph.poses.size(), nullptr) {
    for (const MapConstraint& constraint : graph.constraints) {
      const PoseConstraint& measured = constraint.measured;
      if (constraint.kind == MapConstraint::Kind::kSequential && measured.to == measured.from + 1)
        step_to_[static_cast<std::size_t>(measured.to)] = &measured;
    }
  }

  /// What was measured from one local map to a later one, with its covariance.
  struct Leg {
    Pose2 T_from_to;
    double length_m = 0.0;
    /// Of (x, y, θ) in the frame of `to`.
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  /// Nothing if a step is missing.
  [[nodiscard]] std::optional<Leg> leg(int from, int to) const {
    Leg leg;
    for (int i = from + 1; i <= to; ++i) {
      const PoseConstraint* const step = step_to_[static_cast<std::size_t>(i)];
      if (step == nullptr) return std::nullopt;
      leg.T_from_to = leg.T_from_to * step->T_from_to;
      leg.length_m += step->T_from_to.translation().norm();
      // Errors before this step, seen from its end: the adjoint of its inverse.
      const Pose2 T_to_from = step->T_from_to.inverse();
      Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
      J.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T_to_from.theta).toRotationMatrix();
      J(0, 2) = T_to_from.y;
      J(1, 2) = -T_to_from.x;
      leg.covariance = J * leg.covariance * J.transpose() + step->information.inverse();
    }
    return leg;
  }

 private:
  std::vector<const PoseConstraint*> step_to_;
};

/// Largest standard deviation in plan of a station of the traverse without its loop closures, as
/// seen from the first one.
double open_plan_sd_m(const MapGraph& graph) {
  const OpenTraverse traverse(graph);
  double most = 0.0;
  for (int to = 1; to < static_cast<int>(graph.poses.size()); ++to) {
    const auto leg = traverse.leg(0, to);
    if (!leg) break;
    most = std::max(most, position_sd_m(leg->covariance));
  }
  return most;
}

/// Median distance in plan of the returns from their scans.
double lever_m(const RegisteredCloud& cloud) {
  std::vector<double> levers;
  std::size_t i = 0;
  cloud.for_each_point([&](const SurveyPoint& point) {
    if (i++ % kSampleEvery != 0) return;
    levers.push_back((point.p_survey - point.scan->T_survey_level.translation()).head<2>().norm());
  });
  return median(std::move(levers));
}

}  // namespace

std::vector<TraverseLoop> traverse_loops(const MapGraph& graph) {
  const OpenTraverse traverse(graph);
  std::vector<TraverseLoop> loops;
  for (const MapConstraint& constraint : graph.constraints) {
    if (constraint.kind != MapConstraint::Kind::kLoopClosure) continue;
    PoseConstraint loop_closure = constraint.measured;
    if (loop_closure.from > loop_closure.to) {
      // The covariance of the inverse, seen from the other end.
      const Pose2 T = loop_closure.T_from_to;
      Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
      J.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(T.theta).toRotationMatrix();
      J(0, 2) = T.y;
      J(1, 2) = -T.x;
      const Eigen::Matrix3d covariance = J * loop_closure.information.inverse() * J.transpose();
      loop_closure = {loop_closure.to, loop_closure.from, T.inverse(), covariance.inverse()};
    }
    const auto leg = traverse.leg(loop_closure.from, loop_closure.to);
    if (!leg) continue;
    const Pose2 miss = loop_closure.T_from_to.inverse() * leg->T_from_to;
    const Eigen::Vector3d e(miss.x, miss.y, wrap_angle(miss.theta));
    const Eigen::Matrix3d covariance = leg->covariance + loop_closure.information.inverse();
    loops.push_back({loop_closure.from, loop_closure.to, leg->length_m, e.head<2>().norm(),
                     std::abs(e.z()), e.dot(covariance.inverse() * e)});
  }
  std::ranges::stable_sort(loops, std::ranges::greater{}, &TraverseLoop::chi2);
  return loops;
}

std::vector<BudgetRow> accuracy_budget(const MapGraph& graph, const RegisteredCloud& cloud) {
  double level_sd_rad = 0.0;
  for (const PlacedCloud& scan : cloud.scans())
    level_sd_rad = std::max(level_sd_rad, scan.level_sd_rad);
  const double at_m = lever_m(cloud);
  double plan_sd_m = 0.0;
  double z_sd_m = 0.0;
  for (const SurveyGraph::Node& node : cloud.graph().nodes()) {
    plan_sd_m = std::max(plan_sd_m, position_sd_m(node.covariance));
    z_sd_m = std::max(z_sd_m, std::sqrt(node.z_variance));
  }
  return {
      {"lasers: range of a return", kRangeSdM, kRangeSdM},
      {fmt::format("levelling of 3D scans: {:.1f} mrad at {:.1f} m", 1e3 * level_sd_rad, at_m),
       kNotSaid, level_sd_rad * at_m},
      {"matching: open traverse, its most uncertain station", open_plan_sd_m(graph), kNotSaid},
      {"adjusted with loop closures and control, most uncertain station", plan_sd_m, z_sd_m},
      {"a return from there", std::hypot(plan_sd_m, kRangeSdM),
       std::hypot(z_sd_m, level_sd_rad * at_m, kRangeSdM)},
  };
}

Ellipse95 ellipse_95(const SurveyGraph::Node& station) {
  const auto eigen =
      symmetric_eigen(Eigen::Matrix2d(station.covariance.topLeftCorner<2, 2>()));  // ascending
  return {kEllipse95 * std::sqrt(std::max(0.0, eigen.values[1])),
          kEllipse95 * std::sqrt(std::max(0.0, eigen.values[0])), eigen.vectors.col(1)};
}

std::string loop_table(const std::vector<TraverseLoop>& loops) {
  std::string table =
      "from_local_map,to_local_map,length_m,misclosure_m,misclosure_deg,one_in,chi2\n";
  for (const TraverseLoop& loop : loops) {
    fmt::format_to(std::back_inserter(table), "{},{},{:.2f},{:.4f},{:.3f},{:.0f},{:.2f}\n",
                   loop.from, loop.to, loop.length_m, loop.misclosure_m,
                   rad_to_deg(loop.misclosure_rad),
                   loop.length_m / std::max(1e-4, loop.misclosure_m), loop.chi2);
  }
  return table;
}

}  // namespace adit
