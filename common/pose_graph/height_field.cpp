// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace adit {
namespace {

constexpr double kUnconstrainedM = 1000.0;

using Triplets = std::vector<Eigen::Triplet<double>>;

/// One row of the least squares problem: coefficients of unknowns, by index.
struct Row {
  std::vector<std::pair<int, double>> coefficients;
  double value = 0.0;
  double information = 1.0;
};

Row row_of(const HeightConstraint& constraint, int nodes) {
  Row row;
  if (constraint.from > 0) row.coefficients.emplace_back(constraint.from - 1, -1.0);
  if (constraint.to > 0) row.coefficients.emplace_back(constraint.to - 1, 1.0);
  // A body that seems to pitch up by e too much seems to climb by e times the distance.
  for (const auto& [session, forward_m] : constraint.travels) {
    if (forward_m != 0.0) row.coefficients.emplace_back(nodes - 1 + session, forward_m);
  }
  row.value = constraint.climb_m;
  row.information = 1.0 / (constraint.sd_m * constraint.sd_m);
  return row;
}

}  // namespace

struct HeightField::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky;
};

HeightField::HeightField() = default;
HeightField::~HeightField() = default;
HeightField::HeightField(HeightField&&) noexcept = default;
HeightField& HeightField::operator=(HeightField&&) noexcept = default;

HeightField::HeightField(int nodes, const std::vector<HeightConstraint>& constraints,
                         const std::function<PitchPrior(int session)>& pitch_prior)
    : nodes_(std::max(nodes, 1)) {
  int sessions = 0;
  for (const HeightConstraint& constraint : constraints) {
    for (const auto& travel : constraint.travels) {
      sessions = std::max(sessions, travel.session + 1);
    }
  }
  const int unknowns = nodes_ - 1 + sessions;
  if (unknowns == 0) return;
  Triplets triplets;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns);
  for (int i = 0; i < nodes_ - 1; ++i) {
    triplets.emplace_back(i, i, 1.0 / (kUnconstrainedM * kUnconstrainedM));
  }
  for (int session = 0; session < sessions; ++session) {
    const int i = nodes_ - 1 + session;
    const PitchPrior prior = pitch_prior(session);
    const double information = 1.0 / (prior.sd_rad * prior.sd_rad);
    triplets.emplace_back(i, i, information);
    b[i] += information * prior.error_rad;
  }
  for (const HeightConstraint& constraint : constraints) {
    const Row row = row_of(constraint, nodes_);
    for (const auto& [i, a] : row.coefficients) {
      b[i] += row.information * a * row.value;
      for (const auto& [k, c] : row.coefficients) {
        triplets.emplace_back(i, k, row.information * a * c);
      }
    }
  }
  Eigen::SparseMatrix<double> information(unknowns, unknowns);
  information.setFromTriplets(triplets.begin(), triplets.end());
  factor_ = std::make_unique<Factor>();
  factor_->cholesky.compute(information);
  solution_ = factor_->cholesky.solve(b);
}

double HeightField::height_m(int node) const { return node == 0 ? 0.0 : solution_[node - 1]; }

double HeightField::variance(int from, int to) const {
  if (from == to) return 0.0;
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(solution_.size());
  if (from > 0) difference[from - 1] = -1.0;
  if (to > 0) difference[to - 1] = 1.0;
  return difference.dot(factor_->cholesky.solve(difference));
}

Eigen::VectorXd HeightField::variances_to(int node) const {
  Eigen::VectorXd variances(nodes_);
  for (int i = 0; i < nodes_; ++i) variances[i] = variance(node, i);
  return variances;
}

double HeightField::pitch_error_rad(int session) const {
  const Eigen::Index i = nodes_ - 1 + session;
  return session >= 0 && i < solution_.size() ? solution_[i] : 0.0;
}

}  // namespace adit
