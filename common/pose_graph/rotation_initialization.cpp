// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/rotation_initialization.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

namespace adit {
namespace {

constexpr double kWeightFloor = 1e-6;  // of the information, if the rotation alone is unconstrained
constexpr int kRewindsMax = 10;        // limit for a loop whose number of turns alternates

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The information on the rotation alone [1/rad²].
double rotation_weight(const PoseConstraint& c) {
  const Eigen::Matrix2d A = c.information.topLeftCorner<2, 2>();
  const Eigen::Vector2d v = c.information.topRightCorner<2, 1>();
  const double full = c.information(2, 2);
  const double grain = 1e-9 * (A.trace() + 1e-300);  // A may be singular
  const double det = (A(0, 0) + grain) * (A(1, 1) + grain) - A(0, 1) * A(0, 1);
  const double explained = ((A(1, 1) + grain) * v.x() * v.x() - 2.0 * A(0, 1) * v.x() * v.y() +
                            (A(0, 0) + grain) * v.y() * v.y()) /
                           det;
  return std::max(full - explained, kWeightFloor * full);
}

/// A constraint seen from one of its nodes.
struct Link {
  int to;
  double rotation;  ///< of `to` relative to that node [rad]
  double variance;
};

class Links {
 public:
  Links(const PoseGraph& graph, const std::vector<double>& weights)
      : start_(graph.poses.size() + 1, 0), links_(2 * graph.constraints.size()) {
    for (const PoseConstraint& c : graph.constraints) {
      ++start_[at(c.from) + 1];
      ++start_[at(c.to) + 1];
    }
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
      const PoseConstraint& c = graph.constraints[i];
      const double variance = 1.0 / weights[i];
      links_[next[at(c.from)]++] = {c.to, c.T_from_to.theta, variance};
      links_[next[at(c.to)]++] = {c.from, -c.T_from_to.theta, variance};
    }
  }
  [[nodiscard]] const Link* begin(int node) const { return links_.data() + start_[at(node)]; }
  [[nodiscard]] const Link* end(int node) const { return links_.data() + start_[at(node) + 1]; }

 private:
  std::vector<std::size_t> start_;
  std::vector<Link> links_;
};

/// Orientations along the tree of least variance from node 0 (Dijkstra 1959), so that few and
/// accurate rotations accumulate.
std::vector<double> orientations_of_tree(const PoseGraph& graph,
                                         const std::vector<double>& weights) {
  const Links links(graph, weights);
  using Entry = std::tuple<double, int, double>;  // variance, node, orientation
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> theta(graph.poses.size());
  std::vector<char> reached(graph.poses.size(), 0);
  queue.emplace(0.0, 0, graph.poses.front().theta);
  while (!queue.empty()) {
    const auto [variance, node, orientation] = queue.top();
    queue.pop();
    if (reached[at(node)] != 0) continue;
    reached[at(node)] = 1;
    theta[at(node)] = orientation;
    for (const Link* link = links.begin(node); link != links.end(node); ++link) {
      if (reached[at(link->to)] != 0) continue;
      queue.emplace(variance + link->variance, link->to, orientation + link->rotation);
    }
  }
  return theta;
}

using Scalar = Eigen::Matrix<double, 1, 1>;

/// The weighted Laplacian of the graph, without node 0.
SparseCholesky laplacian(const PoseGraph& graph, const GraphStructure& structure,
                         const std::vector<double>& weights) {
  SparseCholesky A(structure.pattern, structure.ordering, 1);
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const PoseConstraint& c = graph.constraints[i];
    if (c.from != 0) A.add_to_diagonal<1>(c.from - 1, Scalar(weights[i]));
    if (c.to != 0) A.add_to_diagonal<1>(c.to - 1, Scalar(weights[i]));
    const int pair = structure.pair_of_constraint[i];
    if (pair >= 0) A.add_to_pair<1>(pair, Scalar(-weights[i]));
  }
  return A;
}

/// The right-hand side: the rotation residuals, each wrapped at the present orientations.
Eigen::VectorXd right_hand_side(const PoseGraph& graph, const std::vector<double>& weights,
                                const std::vector<double>& theta) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(theta.size()) - 1);
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    const PoseConstraint& c = graph.constraints[i];
    const double off =
        weights[i] * wrap_angle(theta[at(c.to)] - theta[at(c.from)] - c.T_from_to.theta);
    if (c.from != 0) b[c.from - 1] += off;
    if (c.to != 0) b[c.to - 1] -= off;
  }
  return b;
}

}  // namespace

std::vector<double> solve_rotations(const PoseGraph& graph, const GraphStructure& structure) {
  std::vector<double> weights;
  for (const PoseConstraint& c : graph.constraints) weights.push_back(rotation_weight(c));
  std::vector<double> theta = orientations_of_tree(graph, weights);
  SparseCholesky A = laplacian(graph, structure, weights);
  if (!A.factorise()) return theta;
  double step = 1.0;
  // The system is linear: the second step is zero unless a number of turns has changed.
  for (int i = 0; i < kRewindsMax && step > 1e-6; ++i) {
    const Eigen::VectorXd delta = A.solve(right_hand_side(graph, weights, theta));
    for (std::size_t n = 1; n < theta.size(); ++n) {
      theta[n] += delta[static_cast<Eigen::Index>(n) - 1];
    }
    step = delta.lpNorm<Eigen::Infinity>();
  }
  return theta;
}

bool initialize_from_rotations(PoseGraph& graph, const GraphStructure& structure,
                               NormalEquations& equations) {
  const std::vector<double> theta = solve_rotations(graph, structure);
  const std::vector<Pose2> before = graph.poses;
  for (std::size_t i = 1; i < theta.size(); ++i) graph.poses[i].theta = theta[i];
  equations.linearise_at_measurements(graph);
  if (!equations.matrix().factorise()) {
    graph.poses = before;
    return false;
  }
  move_poses(equations.matrix().solve(equations.b()), graph.poses);
  return true;
}

}  // namespace adit
