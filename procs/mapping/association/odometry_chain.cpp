// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/odometry_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

constexpr double kInformationMin = 1.0 / (30.0 * 30.0);

Eigen::Matrix3d moved(const Eigen::Matrix3d& covariance, const Pose2& T) {
  const Eigen::Matrix3d Ad = adjoint(T);
  return Ad * covariance * Ad.transpose();
}

CycleResidual residual_of(const UncertainPose& cycle) {
  const Eigen::Vector3d e = cycle.T_from_to.vector();
  return {e.dot(solve_symmetric(cycle.covariance, e)), cycle.covariance};
}

}  // namespace

UncertainPose operator*(const UncertainPose& a, const UncertainPose& b) {
  return {a.T_from_to * b.T_from_to, moved(a.covariance, b.T_from_to.inverse()) + b.covariance};
}

UncertainPose inverse(const UncertainPose& a) {
  return {a.T_from_to.inverse(), moved(a.covariance, a.T_from_to)};
}

UncertainPose measured_by(const PoseConstraint& constraint) {
  const Eigen::Matrix3d information =
      constraint.information + kInformationMin * Eigen::Matrix3d::Identity();
  return {constraint.T_from_to, information.inverse()};
}

void OdometryChain::add_map(const UncertainPose& T_previous_map) {
  Node node;
  if (!nodes_.empty()) {
    const Node& last = nodes_.back();
    node.T_first_map = last.T_first_map * T_previous_map.T_from_to;
    node.covariance = last.covariance + moved(T_previous_map.covariance, node.T_first_map);
    node.length_m = last.length_m + T_previous_map.T_from_to.translation().norm();
  }
  nodes_.push_back(node);
}

UncertainPose OdometryChain::between(int from, int to) const {
  const Pose2 T_to_first = at(to).T_first_map.inverse();
  const Eigen::Matrix3d steps =
      at(std::max(from, to)).covariance - at(std::min(from, to)).covariance;
  return {adit::between(at(from).T_first_map, at(to).T_first_map), moved(steps, T_to_first)};
}

double OdometryChain::area_m2() const {
  Eigen::AlignedBox2d box;
  for (const Node& node : nodes_) box.extend(node.T_first_map.translation());
  return box.isEmpty() ? 0.0 : box.volume();
}

double chance_of_fit(const Eigen::Matrix3d& covariance, double gate, double area_m2) {
  const double volume = std::sqrt(std::max(0.0, covariance.determinant()));
  const double ellipsoid = 4.0 / 3.0 * std::numbers::pi * std::pow(gate, 1.5) * volume;
  return std::min(1.0, ellipsoid / (2.0 * std::numbers::pi * area_m2));
}

CycleResidual cycle_residual(const OdometryChain& odometry, const PoseConstraint& a,
                             const PoseConstraint& b) {
  return residual_of(odometry.between(a.from, b.from) * measured_by(b) *
                     odometry.between(b.to, a.to) * inverse(measured_by(a)));
}

CycleResidual cycle_residual(const OdometryChain& odometry, const PoseConstraint& loop_closure) {
  return residual_of(odometry.between(loop_closure.from, loop_closure.to) *
                     inverse(measured_by(loop_closure)));
}

}  // namespace adit
