// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/incremental_field.hpp"

#include <algorithm>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "common/pose_graph/gaussian_field.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

constexpr double kTolerance = 1e-9;  // m, rad; also relative, of covariances

/// An incremental field beside its graph, of which the batch field is made.
class GrowingGraph {
 public:
  GrowingGraph(const PoseGraph& source, std::uint32_t seed) : source_(source), random_(seed) {
    add_node();
    add_node();
  }

  [[nodiscard]] int nodes() const { return field.nodes(); }

  void add_node() {
    const int node = field.add_node(source_.poses[static_cast<std::size_t>(field.nodes())]);
    graph.poses.push_back(field.linearisation_point(node));
    if (node > 0) {
      add({node - 1, node, step(node).T_from_to, step(node).information});
    }
  }

  void add_loop() {
    const int to = below(nodes());
    const int from = below(nodes());
    if (from == to) return;
    const Pose2 noise{0.05 * normal(), 0.05 * normal(), 0.01 * normal()};
    const auto& poses = source_.poses;
    const Pose2 T = between(poses[std::size_t(from)], poses[std::size_t(to)]) * noise;
    add({from, to, T, step(1 + below(nodes() - 1)).information});
    loops_.push_back(ids_.back());
  }

  void remove_loop() {
    if (loops_.empty()) return;
    const auto loop = loops_.begin() + below(static_cast<int>(loops_.size()));
    const auto k = std::ranges::find(ids_, *loop) - ids_.begin();
    field.remove(*loop);
    ids_.erase(ids_.begin() + k);
    graph.constraints.erase(graph.constraints.begin() + k);
    loops_.erase(loop);
  }

  void remove_newest_node() {
    const int newest = nodes() - 1;
    for (std::size_t k = ids_.size(); k-- > 0;) {
      if (graph.constraints[k].from != newest && graph.constraints[k].to != newest) continue;
      field.remove(ids_[k]);
      std::erase(loops_, ids_[k]);
      ids_.erase(ids_.begin() + std::ptrdiff_t(k));
      graph.constraints.erase(graph.constraints.begin() + std::ptrdiff_t(k));
    }
    field.remove_newest_node();
    graph.poses.pop_back();
  }

  /// Linearises some nodes elsewhere.
  void move() {
    for (int i = 0; i < 3; ++i) {
      const int node = below(nodes());
      const Pose2 moved =
          graph.poses[std::size_t(node)] * Pose2{0.02 * normal(), 0.0, 0.005 * normal()};
      if (node == 0) continue;
      field.move(node, moved);
      graph.poses[std::size_t(node)] = moved;
    }
  }

  void expect_equal_to_batch() {
    const GaussianField batch(graph);
    const std::vector<Pose2> poses = batch.poses();
    for (int node = 0; node < nodes(); ++node) {
      const Pose2 error = between(poses[std::size_t(node)], field.pose(node));
      ASSERT_LT(error.vector().norm(), kTolerance) << "node " << node << " of " << nodes();
    }
    ASSERT_NEAR(field.objective(), batch.objective(), 1e-7 * (1.0 + batch.objective()));
    for (int k = 0; k < 5; ++k) {
      const int from = k == 0 ? 0 : below(nodes());
      const int to = k < 3 ? nodes() - 1 : below(nodes());
      if (from == to) continue;
      const Eigen::Matrix3d expected = batch.relative_covariance(from, to);
      ASSERT_LT((field.relative_covariance(from, to) - expected).norm(), 1e-7 * expected.norm())
          << from << " to " << to << " of " << nodes();
      const PoseConstraint query{from, to, {0.3, -0.2, 0.05}, step(1).information};
      const double increase = batch.objective_increase(query);
      ASSERT_NEAR(field.objective_increase(query), increase, 1e-7 * (1.0 + increase));
    }
  }

  /// Of a node in node 0, by what each constraint contributes.
  [[nodiscard]] Eigen::Matrix3d covariance_by_responses(int node) const {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const int id : ids_) {
      const Eigen::Matrix3d K = field.response(node, id);
      covariance += K * field.constraint(id).information.inverse() * K.transpose();
    }
    return covariance;
  }

  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }

  IncrementalField field{1e-10};
  PoseGraph graph;

 private:
  double normal() { return std::normal_distribution<double>()(random_); }

  void add(const PoseConstraint& c) {
    ids_.push_back(field.add(c));
    graph.constraints.push_back(c);
  }

  [[nodiscard]] const PoseConstraint& step(int node) const {
    return *std::ranges::find_if(source_.constraints, [&](const PoseConstraint& c) {
      return c.from == node - 1 && c.to == node;
    });
  }

  const PoseGraph& source_;
  std::mt19937 random_;
  std::vector<int> ids_;    // of the graph's constraints
  std::vector<int> loops_;  // ids
};

TEST(IncrementalField, CovarianceIsTheSumOfTheResponsesToAllConstraints) {
  const PoseGraph source = test::square_trajectory_graph(60, 5, 0.05, 3);
  GrowingGraph growing(source, 3);
  while (growing.nodes() < 60) growing.add_node();
  for (int i = 0; i < 20; ++i) growing.add_loop();
  growing.field.update();
  for (const int node : {1, 20, 59}) {
    const Eigen::Matrix3d expected = growing.field.relative_covariance(0, node);
    EXPECT_LT((growing.covariance_by_responses(node) - expected).norm(), 1e-9 * expected.norm());
  }
}

class IncrementalFieldOfSeed : public testing::TestWithParam<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Seeds, IncrementalFieldOfSeed, testing::Range(1U, 13U));

TEST_P(IncrementalFieldOfSeed, EqualsTheBatchFieldAfterAnyChanges) {
  const PoseGraph source = test::square_trajectory_graph(160, 5, 0.05, GetParam());
  GrowingGraph growing(source, GetParam());
  for (int step = 0; step < 300; ++step) {
    bool only_new_nodes = true;
    for (int change = growing.below(3); change >= 0; --change) {
      const int kind = growing.below(12);
      const bool adds_node = kind < 6 && growing.nodes() < 160;
      only_new_nodes &= adds_node;
      if (adds_node) growing.add_node();
      if (kind >= 6 && kind < 9) growing.add_loop();
      if (kind == 9) growing.remove_loop();
      if (kind == 10 && growing.nodes() > 3) growing.remove_newest_node();
      if (kind == 11) growing.move();
    }
    growing.field.update(only_new_nodes && step > 0);
    growing.expect_equal_to_batch();
    if (HasFatalFailure()) FAIL() << "step " << step;
  }
}

TEST(IncrementalField, EliminatesFewNodesForEachOfAChain) {
  const PoseGraph source = test::square_trajectory_graph(3000, 5, 0.0);
  GrowingGraph growing(source, 1);
  growing.field.update();
  long eliminated = 0;
  while (growing.nodes() < 3000) {
    growing.add_node();
    growing.field.update(true);
    eliminated += growing.field.tree().eliminated();
  }
  EXPECT_LT(eliminated / 3000, 20);              // amortised, logarithmic
  EXPECT_LT(growing.field.tree().height(), 60);  // balanced
  growing.expect_equal_to_batch();
}

TEST(IncrementalField, RejectsAPoseThatIsFreeToMove) {
  IncrementalField field{1e-10};
  field.add_node({});
  field.add_node({});
  field.add_node({});
  field.add({0, 1, {}, Eigen::Matrix3d::Identity()});
  EXPECT_THROW(field.update(), std::runtime_error);
}

}  // namespace
}  // namespace adit
