// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/height_field.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace adit {
namespace {

constexpr double kUnconstrainedM = 1000.0;
constexpr double kUnchanged = 1e-7;  // of heights and pitch errors on which others depend [m, rad]

}  // namespace

HeightField::HeightField(double pitch_sd_rad) : pitch_sd_rad_(pitch_sd_rad), tree_(1, kUnchanged) {}

HeightField::HeightField(int nodes, const std::vector<HeightConstraint>& constraints,
                         double pitch_sd_rad)
    : HeightField(pitch_sd_rad) {
  for (int node = 1; node < nodes; ++node) add_node();
  for (const HeightConstraint& constraint : constraints) add(constraint);
  update();
}

int HeightField::add_prior(int block, double mean, double sd) {
  const double information = 1.0 / (sd * sd);
  return tree_.add_term({{block},
                         Eigen::MatrixXd::Constant(1, 1, information),
                         Eigen::VectorXd::Constant(1, information * mean)});
}

HeightField::Unknown HeightField::add_unknown(double mean, double sd, bool of_session) {
  Unknown unknown;
  unknown.block = tree_.add_block(of_session);
  unknown.prior = add_prior(unknown.block, mean, sd);
  return unknown;
}

void HeightField::add_node() { nodes_.push_back(add_unknown(0.0, kUnconstrainedM, false)); }

void HeightField::set_pitch_prior(int session, const PitchPrior& prior) {
  pitch_priors_[session] = prior;
  const auto s = static_cast<std::size_t>(session);
  if (s >= pitch_.size()) return;
  tree_.remove_term(pitch_[s].prior);
  pitch_[s].prior = add_prior(pitch_[s].block, prior.error_rad, prior.sd_rad);
}

/// And the sessions that began with it.
void HeightField::remove_newest_node() {
  const Unknown node = nodes_.back();
  nodes_.pop_back();
  while (!pitch_.empty() && pitch_.back().block > node.block) {
    tree_.remove_term(pitch_.back().prior);
    tree_.remove_newest_block();
    pitch_.pop_back();
  }
  tree_.remove_term(node.prior);
  tree_.remove_newest_block();
}

/// A body that seems to pitch up by e too much seems to climb by e times the distance.
int HeightField::add(const HeightConstraint& constraint) {
  std::map<int, double> coefficients;  // by block
  if (constraint.from > 0) coefficients[block_of(constraint.from)] -= 1.0;
  if (constraint.to > 0) coefficients[block_of(constraint.to)] += 1.0;
  for (const auto& [session, forward_m] : constraint.travels) {
    while (static_cast<int>(pitch_.size()) <= session) {
      const auto known = pitch_priors_.find(static_cast<int>(pitch_.size()));
      const PitchPrior prior =
          known == pitch_priors_.end() ? PitchPrior{0.0, pitch_sd_rad_} : known->second;
      pitch_.push_back(add_unknown(prior.error_rad, prior.sd_rad, true));
    }
    if (forward_m == 0.0) continue;
    coefficients[pitch_[static_cast<std::size_t>(session)].block] += forward_m;
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
  return session >= 0 && s < pitch_.size() ? tree_.solution(pitch_[s].block)[0] : 0.0;
}

}  // namespace adit
