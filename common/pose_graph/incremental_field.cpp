// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/incremental_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "common/geometry/symmetric_eigen.hpp"
#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

/// Node 0 is no block of the tree: node i is block i − 1.
int IncrementalField::add_node(const Pose2& T_map_node) {
  if (!poses_.empty()) tree_.add_block();
  poses_.push_back(T_map_node);
  constraints_of_.emplace_back();
  return nodes() - 1;
}

void IncrementalField::remove_newest_node() {
  poses_.pop_back();
  constraints_of_.pop_back();
  if (!poses_.empty()) tree_.remove_newest_block();
}

int IncrementalField::add(const PoseConstraint& constraint) {
  int id = static_cast<int>(constraints_.size());
  if (free_.empty()) {
    constraints_.emplace_back();
    term_.push_back(-1);
    constant_.push_back(0.0);
  } else {
    id = free_.back();
    free_.pop_back();
  }
  constraints_[at(id)] = constraint;
  for (const int node : {constraint.from, constraint.to}) constraints_of_[at(node)].push_back(id);
  stale_.push_back(id);
  return id;
}

void IncrementalField::remove(int id) {
  const PoseConstraint& constraint = constraints_[at(id)];
  for (const int node : {constraint.from, constraint.to}) {
    std::erase(constraints_of_[at(node)], id);
  }
  if (term_[at(id)] >= 0) tree_.remove_term(term_[at(id)]);
  std::erase(stale_, id);
  objective_at_linearisation_ -= constant_[at(id)];
  term_[at(id)] = -1;
  constant_[at(id)] = 0.0;
  free_.push_back(id);
}

void IncrementalField::move(int node, const Pose2& T_map_node) {
  poses_[at(node)] = T_map_node;
  const std::vector<int>& linked = constraints_of_[at(node)];
  stale_.insert(stale_.end(), linked.begin(), linked.end());
}

void IncrementalField::update(bool only_new_nodes) {
  std::ranges::sort(stale_);
  stale_.erase(std::unique(stale_.begin(), stale_.end()), stale_.end());
  for (const int id : std::exchange(stale_, {})) linearise(id);
  if (!tree_.update(only_new_nodes)) {
    throw std::runtime_error("the constraints of the pose graph leave a pose free to move");
  }
}

void IncrementalField::linearise(int id) {
  const PoseConstraint& c = constraints_[at(id)];
  BayesTree::Term term = term_of(c);
  const LinearPotential p = adit::linearise(c, poses_[at(c.from)], poses_[at(c.to)]);
  const double constant = energy(c, p.e);
  objective_at_linearisation_ += constant - constant_[at(id)];
  constant_[at(id)] = constant;
  if (term_[at(id)] >= 0) {
    tree_.set_term(term_[at(id)], std::move(term.H), std::move(term.b));
  } else {
    term_[at(id)] = tree_.add_term(std::move(term));
  }
}

/// Jᵀ R J and −Jᵀ R e.
BayesTree::Term IncrementalField::term_of(const PoseConstraint& c) {
  const LinearPotential p = adit::linearise(c, poses_[at(c.from)], poses_[at(c.to)]);
  BayesTree::Term term;
  Eigen::Matrix<double, 3, Eigen::Dynamic> J(3, 0);
  const auto append = [&](int node, const Eigen::Matrix3d& by_node) {
    if (node == 0) return;
    term.blocks.push_back(node - 1);
    J.conservativeResize(3, J.cols() + 3);
    J.rightCols<3>() = by_node;
  };
  append(c.from, p.jacobian_from());
  append(c.to, p.J_to);
  term.H = J.transpose() * c.information * J;
  term.b = -J.transpose() * (c.information * p.e);
  return term;
}

Eigen::Vector3d IncrementalField::mode(int node) const {
  if (node == 0) return Eigen::Vector3d::Zero();
  return tree_.solution(node - 1);
}

Pose2 IncrementalField::pose(int node) const {
  return Pose2::from_vector(poses_[at(node)].vector() + mode(node));
}

std::vector<int> IncrementalField::changed() const {
  std::vector<int> nodes;
  for (const int block : tree_.moved()) nodes.push_back(block + 1);
  return nodes;
}

double IncrementalField::objective() const {
  return std::max(0.0, objective_at_linearisation_ - tree_.decrease());
}

Eigen::Matrix3d IncrementalField::covariance(int from, int to, const LinearPotential& p) const {
  const Eigen::Matrix3d J_from = p.jacobian_from();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  if (from == to) return covariance;
  if (from != 0) covariance += J_from * tree_.covariance(from - 1) * J_from.transpose();
  if (to != 0) covariance += p.J_to * tree_.covariance(to - 1) * p.J_to.transpose();
  if (from != 0 && to != 0) {
    const Eigen::Matrix3d cross = J_from * tree_.covariance(from - 1, to - 1) * p.J_to.transpose();
    covariance += cross + cross.transpose();
  }
  return covariance;
}

Eigen::Matrix3d IncrementalField::predicted_covariance(const PoseConstraint& c) const {
  return covariance(c.from, c.to, adit::linearise(c, poses_[at(c.from)], poses_[at(c.to)]));
}

/// dᵀ (Σ + R⁻¹)⁻¹ d with R = G Gᵀ, as R may be singular.
double IncrementalField::objective_increase(const PoseConstraint& c) const {
  const LinearPotential p = adit::linearise(c, poses_[at(c.from)], poses_[at(c.to)]);
  const Eigen::Vector3d d = p.e + p.jacobian_from() * mode(c.from) + p.J_to * mode(c.to);
  const SymmetricEigen<3> eigen = symmetric_eigen(c.information);
  const Eigen::Matrix3d G = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const Eigen::Vector3d Gd = G.transpose() * d;
  const Eigen::Matrix3d S =
      Eigen::Matrix3d::Identity() + G.transpose() * covariance(c.from, c.to, p) * G;
  return Gd.dot(solve_symmetric(S, Gd));
}

Eigen::Matrix3d IncrementalField::response(int node, int id) const {
  if (node == 0) return Eigen::Matrix3d::Zero();
  const PoseConstraint& c = constraints_[at(id)];
  const LinearPotential p = adit::linearise(c, poses_[at(c.from)], poses_[at(c.to)]);
  Eigen::Matrix3d of_residual = Eigen::Matrix3d::Zero();  // its covariance with the node
  if (c.from != 0) of_residual += p.jacobian_from() * tree_.covariance(c.from - 1, node - 1);
  if (c.to != 0) of_residual += p.J_to * tree_.covariance(c.to - 1, node - 1);
  const LinearPotential in_first =
      adit::linearise(PoseConstraint{}, poses_.front(), poses_[at(node)]);
  return in_first.J_to * of_residual.transpose() * c.information;
}

/// As in GaussianField: at the linearisation, against the identity.
Eigen::Matrix3d IncrementalField::relative_covariance(int from, int to) const {
  return covariance(from, to, adit::linearise(PoseConstraint{}, poses_[at(from)], poses_[at(to)]));
}

}  // namespace adit
