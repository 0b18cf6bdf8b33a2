// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/robust_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/pose_graph.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

constexpr double kChiSquare99 = 11.345;  // three degrees of freedom
constexpr int kRoundsMax = 30;
constexpr double kWeightTolerance = 1e-3;
constexpr double kWeightMin =
    1e-9;  // a graph with parts connected by a single loop must stay determined

using Kernel = double (*)(double chi_square);

double chi_square(const PoseConstraint& c, const std::vector<Pose2>& poses) {
  return energy(c, residual(c, poses[static_cast<std::size_t>(c.from)],
                            poses[static_cast<std::size_t>(c.to)]));
}

std::vector<double> weights(const PoseGraph& graph, const std::vector<Pose2>& poses,
                            Kernel kernel) {
  std::vector<double> result;
  for (const PoseConstraint& c : graph.constraints) {
    const double weight = test::is_loop(c) ? kernel(chi_square(c, poses)) : 1.0;
    result.push_back(std::max(weight, kWeightMin));
  }
  return result;
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  double change = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) change = std::max(change, std::abs(a[i] - b[i]));
  return change;
}

std::vector<bool> reweight_and_select(const PoseGraph& graph, Kernel kernel) {
  const OptimizeParams short_optimization{
      .rotation_initialization = false, .tolerance = 1e-4, .iterations_max = 5};
  PoseGraph weighted = graph;
  chain_odometry(weighted);
  std::vector<double> before(graph.constraints.size(), 0.0);
  for (int round = 0; round < kRoundsMax; ++round) {
    const std::vector<double> now = weights(graph, weighted.poses, kernel);
    if (largest_change(now, before) < kWeightTolerance) break;
    for (std::size_t i = 0; i < now.size(); ++i) {
      weighted.constraints[i].information = now[i] * graph.constraints[i].information;
    }
    optimize(weighted, short_optimization);
    before = now;
  }
  std::vector<bool> accepted;
  for (const PoseConstraint& c : graph.constraints) {
    accepted.push_back(!test::is_loop(c) || chi_square(c, weighted.poses) < kChiSquare99);
  }
  return accepted;
}

}  // namespace

std::vector<bool> accepted_by_huber(const PoseGraph& graph) {
  return reweight_and_select(graph,
                             [](double chi) { return chi > 1.0 ? 1.0 / std::sqrt(chi) : 1.0; });
}

std::vector<bool> accepted_by_dcs(const PoseGraph& graph) {
  return reweight_and_select(graph, [](double chi) {
    const double s = std::min(1.0, 2.0 / (1.0 + chi));
    return s * s;
  });
}

namespace {

constexpr double kGncFactor = 1.4;
constexpr int kGncRoundsMax = 100;

/// Weight of the surrogate of truncated least squares (equation 14 of the paper).
double truncated_weight(double chi, double mu) {
  if (chi >= (mu + 1.0) / mu * kChiSquare99) return 0.0;
  if (chi <= mu / (mu + 1.0) * kChiSquare99) return 1.0;
  return std::sqrt(kChiSquare99 * mu * (mu + 1.0) / chi) - mu;
}

bool are_binary(const std::vector<double>& weights) {
  return std::ranges::all_of(
      weights, [](double w) { return w > 1.0 - kWeightTolerance || w < kWeightTolerance; });
}

}  // namespace

std::vector<bool> accepted_by_gnc(const PoseGraph& graph) {
  PoseGraph weighted = graph;
  optimize(weighted, {});
  double largest = 0.0;
  for (const PoseConstraint& c : graph.constraints) {
    if (test::is_loop(c)) largest = std::max(largest, chi_square(c, weighted.poses));
  }
  if (largest <= kChiSquare99) return std::vector<bool>(graph.constraints.size(), true);
  double mu = kChiSquare99 / (2.0 * largest - kChiSquare99);
  std::vector<double> w(graph.constraints.size(), 1.0);
  for (int round = 0; round < kGncRoundsMax; ++round, mu *= kGncFactor) {
    for (std::size_t i = 0; i < w.size(); ++i) {
      const PoseConstraint& c = graph.constraints[i];
      w[i] = test::is_loop(c) ? truncated_weight(chi_square(c, weighted.poses), mu) : 1.0;
      weighted.constraints[i].information = std::max(w[i], kWeightMin) * c.information;
    }
    if (round > 0 && are_binary(w)) break;
    optimize(weighted, {.rotation_initialization = false, .iterations_max = 20});
  }
  std::vector<bool> accepted;
  for (const double weight : w) accepted.push_back(weight > 0.5);
  return accepted;
}

}  // namespace adit
