// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/height_field.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

namespace adit {
namespace {

constexpr double kUnconstrainedM = 1000.0;
constexpr double kUnchanged =
    1e-7;  // of heights and attitude errors on which others depend [m, rad]

}  // namespace

HeightField::HeightField(double tilt_sd_rad) : tilt_sd_rad_(tilt_sd_rad), tree_(1, kUnchanged) {}

HeightField::HeightField(int nodes, const std::vector<HeightConstraint>& constraints,
                         double tilt_sd_rad)
    : HeightField(tilt_sd_rad) {
  for (int node = 1; node < nodes; ++node) add_node();
  for (const HeightConstraint& constraint : constraints) add(constraint);
  update();
}

int HeightField::add_prior(const Tilt& tilt, const TiltPrior& prior) {
  const Eigen::Matrix2d information = prior.covariance.inverse();
  return tree_.add_term({{tilt.pitch, tilt.roll}, information, information * prior.error_rad});
}

int HeightField::add_node() {
  Node node;
  node.block = tree_.add_block(false);
  constexpr double kInformation = 1.0 / (kUnconstrainedM * kUnconstrainedM);
  node.prior = tree_.add_term(
      {{node.block}, Eigen::MatrixXd::Constant(1, 1, kInformation), Eigen::VectorXd::Zero(1)});
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size());
}

void HeightField::set_tilt_prior(int session, const TiltPrior& prior) {
  tilt_priors_[session] = prior;
  const auto s = static_cast<std::size_t>(session);
  if (s >= tilts_.size()) return;
  tree_.remove_term(tilts_[s].prior);
  tilts_[s].prior = add_prior(tilts_[s], prior);
}

/// And the sessions that began with it.
void HeightField::remove_newest_node() {
  const Node node = nodes_.back();
  nodes_.pop_back();
  while (!tilts_.empty() && tilts_.back().pitch > node.block) {
    tree_.remove_term(tilts_.back().prior);
    tree_.remove_newest_block();
    tree_.remove_newest_block();
    tilts_.pop_back();
  }
  tree_.remove_term(node.prior);
  tree_.remove_newest_block();
}

const HeightField::Tilt& HeightField::tilt_of(int session) {
  while (static_cast<int>(tilts_.size()) <= session) {
    const auto known = tilt_priors_.find(static_cast<int>(tilts_.size()));
    const TiltPrior unknown{.covariance =
                                tilt_sd_rad_ * tilt_sd_rad_ * Eigen::Matrix2d::Identity()};
    Tilt tilt;
    tilt.pitch = tree_.add_block(true);
    tilt.roll = tree_.add_block(true);
    tilt.prior = add_prior(tilt, known == tilt_priors_.end() ? unknown : known->second);
    tilts_.push_back(tilt);
  }
  return tilts_[static_cast<std::size_t>(session)];
}

/// A body that seems to pitch up by e too much seems to climb by e times the distance.
int HeightField::add(const HeightConstraint& constraint) {
  std::map<int, double> coefficients;  // by block
  if (constraint.from > 0) coefficients[block_of(constraint.from)] -= 1.0;
  if (constraint.to > 0) coefficients[block_of(constraint.to)] += 1.0;
  for (const auto& [session, forward_m, left_m] : constraint.travels) {
    const Tilt& tilt = tilt_of(session);
    if (forward_m != 0.0) coefficients[tilt.pitch] += forward_m;
    if (left_m != 0.0) coefficients[tilt.roll] += left_m;
  }
  BayesTree::Term term;
  Eigen::VectorXd row(static_cast<Eigen::Index>(coefficients.size()));
  for (const auto& [block, coefficient] : coefficients) {
    row[static_cast<Eigen::Index>(term.blocks.size())] = coefficient;
    term.blocks.push_back(block);
  }
  const double information = 1.0 / (constraint.sd_m * constraint.sd_m);
  term.H = information * row * row.transpose();
  term.b = information * constraint.climb_m * row;
  return tree_.add_term(std::move(term));
}

/// With its priors, a field determines all unknowns.
void HeightField::update() {
  if (!tree_.update()) throw std::runtime_error("a height constraint that is not finite");
}

double HeightField::height_m(int node) const {
  return node == 0 ? 0.0 : tree_.solution(block_of(node))[0];
}

double HeightField::variance(int from, int to) const {
  if (from == to) return 0.0;
  double variance = 0.0;
  for (const int node : {from, to}) {
    if (node > 0) variance += tree_.covariance(block_of(node))(0, 0);
  }
  if (from > 0 && to > 0) variance -= 2.0 * tree_.covariance(block_of(from), block_of(to))(0, 0);
  return std::max(0.0, variance);
}

Eigen::VectorXd HeightField::variances_to(int node) const {
  Eigen::VectorXd variances(nodes());
  for (int i = 0; i < nodes(); ++i) variances[i] = variance(i, node);
  return variances;
}

double HeightField::pitch_error_rad(int session) const {
  const auto s = static_cast<std::size_t>(session);
  return session >= 0 && s < tilts_.size() ? tree_.solution(tilts_[s].pitch)[0] : 0.0;
}

}  // namespace adit
