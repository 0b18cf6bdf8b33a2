// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/potential.hpp"

namespace adit {
namespace {

constexpr double kTurnMax = 0.01;  // of a map before the field is linearised anew [rad]
constexpr double kTurnFar = 0.5;   // beyond which iteration might not find the way [rad]

double largest_turn(const Eigen::VectorXd& mode) {
  double turn = 0.0;
  for (Eigen::Index i = 2; i < mode.size(); i += 3) turn = std::max(turn, std::abs(mode[i]));
  return turn;
}

}  // namespace

Trial::Trial(const AssociationProblem& problem, Belief belief, int first)
    : problem_(problem), belief_(std::move(belief)), first_(first) {
  if (first_ > 0) {
    fixed_ = belief_.objective - adit::objective(graph_of(problem_, belief_, first_));
  }
}

GaussianField& Trial::field() {
  if (!field_) field_.emplace(graph_of(problem_, belief_, first_));
  return *field_;
}

/// Takes over the poses of the nodes of the graph.
void Trial::set_poses(const std::vector<Pose2>& nodes, Belief& belief) const {
  std::copy(nodes.begin() + (first_ > 0 ? 1 : 0), nodes.end(),
            belief.T_map_local.begin() + first_);
}

Belief Trial::belief() const {
  Belief belief = belief_;
  if (field_) {
    set_poses(field_->poses(), belief);
    belief.objective = objective();
  }
  return belief;
}

double Trial::objective() const {
  return field_ ? fixed_ + field_->objective() : belief_.objective;
}

PoseConstraint Trial::chosen_constraint(int closure) const {
  return in_graph_from(
      constraint_of(problem_.closures[static_cast<std::size_t>(closure)], chosen(closure)), belief_,
      first_);
}

std::vector<GaussianField::Without> Trial::without_each(const std::vector<int>& closures,
                                                        const PoseConstraint& asked) {
  std::vector<PoseConstraint> present;
  for (const int k : closures) present.push_back(chosen_constraint(k));
  return field().without_each(present, in_graph_from(asked, belief_, first_));
}

std::vector<Eigen::Matrix3d> Trial::covariances_to(int map) {
  if (map == 0) return {};
  const int shift = first_ > 0 ? first_ - 1 : 0;  // from a node to its map
  const auto by_node = field().relative_covariances_to(map - shift);
  const std::vector<Pose2> poses = belief().T_map_local;
  std::vector<Eigen::Matrix3d> covariances;
  for (int older = 0; older < map; ++older) {
    const bool fixed = older < first_;
    const Pose2& T_map_older = poses[static_cast<std::size_t>(older)];
    const Pose2& T_map_newer = poses[static_cast<std::size_t>(map)];
    // Of a fixed map as of the frame of map, and from the older frame into the newer one.
    const Pose2 T = fixed ? T_map_newer : between(T_map_older, T_map_newer);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-T.theta).toRotationMatrix();
    const auto node = static_cast<std::size_t>(fixed ? 0 : older - shift);
    covariances.emplace_back(R * by_node[node] * R.transpose());
  }
  return covariances;
}

void Trial::take(int closure, int alternative) {
  const auto k = static_cast<std::size_t>(closure);
  field().add(in_graph_from(constraint_of(problem_.closures[k], alternative), belief_, first_));
  belief_.chosen[k] = alternative;
  const double turn = largest_turn(field().mode());
  if (turn > kTurnMax) settle(turn > kTurnFar);
}

void Trial::revoke(const std::vector<int>& closures) {
  belief_ = belief();
  field_.reset();
  for (const int k : closures) belief_.chosen[static_cast<std::size_t>(k)] = Association::kNone;
  settle();
}

void Trial::settle(bool afresh) {
  belief_ = belief();
  field_.reset();
  PoseGraph graph = graph_of(problem_, belief_, first_);
  OptimizeParams params;
  params.rotation_start = afresh;
  params.tolerance = 1e-6;
  belief_.objective = fixed_ + optimize(graph, params).objective;
  set_poses(graph.poses, belief_);
}

}  // namespace adit
