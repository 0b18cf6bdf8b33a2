// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/certified_optimum.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/pose_graph/g2o_file.hpp"
#include "common/pose_graph/optimize.hpp"
#include "common/pose_graph/quadratic_relaxation.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/support/recordings.hpp"

namespace adit {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double half) {
  return std::uniform_real_distribution<double>(-half, half)(random);
}

Eigen::Matrix3d random_information(Random& random) {
  Eigen::Matrix3d A;
  for (int i = 0; i < 9; ++i) A(i / 3, i % 3) = uniform(random, 3.0);
  return A * A.transpose() + 0.5 * Eigen::Matrix3d::Identity();
}

/// A graph of `nodes` with random constraints: contradictory measurements and correlated errors.
PoseGraph random_graph(int nodes, double noise, unsigned seed) {
  Random random(seed);
  PoseGraph graph;
  for (int i = 0; i < nodes; ++i) {
    graph.poses.push_back({uniform(random, 5.0), uniform(random, 5.0), uniform(random, 3.0)});
  }
  const auto link = [&](int from, int to) {
    const auto pose = [&](int node) { return graph.poses[static_cast<std::size_t>(node)]; };
    Pose2 T_from_to = between(pose(from), pose(to));
    T_from_to =
        T_from_to * Pose2{uniform(random, noise), uniform(random, noise), uniform(random, noise)};
    graph.constraints.push_back({from, to, T_from_to, random_information(random)});
  };
  for (int i = 1; i < nodes; ++i) link(i - 1, i);
  for (int k = 0; k < nodes; ++k) {
    const int from = static_cast<int>(random() % static_cast<unsigned>(nodes));
    const int to = static_cast<int>(random() % static_cast<unsigned>(nodes));
    if (from != to) link(from, to);
  }
  return graph;
}

double form_at(const QuadraticRelaxation& relaxation, const std::vector<Pose2>& poses) {
  const LiftedPoses X = lifted(poses);
  return relaxation.times(X).cwiseProduct(X).sum() + relaxation.offset();
}

TEST(QuadraticRelaxation, TouchesTheObjectiveFromBelow) {
  Random random(7);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    PoseGraph graph = random_graph(8, 0.05, seed);
    QuadraticRelaxation relaxation(graph);
    ASSERT_TRUE(relaxation.tighten_at(graph)) << seed;
    const double there = objective(graph);
    EXPECT_NEAR(form_at(relaxation, graph.poses), there, 1e-9 * there);
    for (int k = 0; k < 200; ++k) {
      PoseGraph moved = graph;
      const double size = std::pow(10.0, uniform(random, 2.0) - 1.0);  // from near to anywhere
      for (Pose2& pose : moved.poses) {
        pose.x += uniform(random, size);
        pose.y += uniform(random, size);
        pose.theta = wrap_angle(pose.theta + uniform(random, size));
      }
      EXPECT_LE(form_at(relaxation, moved.poses), objective(moved) * (1.0 + 1e-9) + 1e-9);
    }
  }
}

TEST(QuadraticRelaxation, MultipliesAndFactorisesTheSameMatrix) {
  PoseGraph graph = random_graph(6, 0.3, 3);
  QuadraticRelaxation relaxation(graph);
  ASSERT_TRUE(relaxation.tighten_at(graph));
  const Eigen::VectorXd shift = Eigen::VectorXd::Constant(6, 1000.0);  // positive definite
  SparseCholesky A = relaxation.shifted(shift);
  ASSERT_TRUE(A.factorise());
  const LiftedPoses X = lifted(graph.poses);
  Eigen::MatrixXd AX = relaxation.times(X);
  for (Eigen::Index i = 0; i < X.rows(); i += 4)
    AX.middleRows<2>(i + 2) += 1000.0 * X.middleRows<2>(i + 2);
  EXPECT_LT((A.solve(AX.col(0)) - X.col(0)).norm(), 1e-9 * X.norm());
}

TEST(CertifiedOptimum, ProvesAConsistentGraph) {
  PoseGraph graph = test::square_trajectory_graph(200, 8, 0.1);
  ASSERT_TRUE(optimize(graph, {.tolerance = 1e-14}).converged);
  const Certificate certificate = certify(graph);
  EXPECT_TRUE(certificate.is_global);
  EXPECT_EQ(certificate.rank, 0);
  EXPECT_FALSE(certificate.replaced);
  EXPECT_LE(certificate.lower_bound, certificate.objective);
}

/// A ring without noise, wound up once: each rotation is off by 2 π / n, a local minimum.
TEST(CertifiedOptimum, UnwindsARing) {
  constexpr int kNodes = 16;
  constexpr double kTurn = 2.0 * std::numbers::pi / kNodes;
  PoseGraph graph;
  for (int i = 0; i < kNodes; ++i) {
    graph.poses.push_back({0.0, 0.0, wrap_angle(i * kTurn)});
    graph.constraints.push_back({i, (i + 1) % kNodes, {}, Eigen::Matrix3d::Identity()});
  }
  ASSERT_TRUE(optimize(graph, {.rotation_initialization = false}).converged);
  ASSERT_NEAR(objective(graph), kNodes * kTurn * kTurn, 1e-6);  // it is a minimum
  const Certificate certificate = certify(graph);
  EXPECT_TRUE(certificate.is_global);
  EXPECT_TRUE(certificate.replaced);
  EXPECT_LT(certificate.objective, 1e-9);
}

/// No minimisation from random starts may end below the lower bound.
TEST(CertifiedOptimum, BoundsTheMinimaFromManyStarts) {
  int proven = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    PoseGraph graph = random_graph(10, seed % 3 == 0 ? 1.5 : 0.05, seed);
    const PoseGraph start = graph;
    optimize(graph, {.tolerance = 1e-14});
    const Certificate certificate = certify(graph);
    EXPECT_NEAR(objective(graph), certificate.objective, 1e-6 * certificate.objective);
    proven += certificate.is_global ? 1 : 0;
    Random random(seed);
    for (int k = 0; k < 30; ++k) {
      PoseGraph other = start;
      for (Pose2& pose : other.poses) {
        pose = {uniform(random, 10.0), uniform(random, 10.0), uniform(random, 3.14)};
      }
      optimize(other, {.rotation_initialization = false});
      EXPECT_GE(objective(other), certificate.lower_bound * (1.0 - 1e-6)) << seed;
    }
  }
  EXPECT_GE(proven, 3);
}

TEST(CertifiedOptimum, FindsAResidualThatNoNoiseExplains) {
  PoseGraph graph = test::square_trajectory_graph(60, 5, 0.1);
  optimize(graph, {});
  EXPECT_FALSE(has_implausible_residual(graph));
  graph.constraints.push_back({0, 40, {50.0, 0.0, 0.0}, 100.0 * Eigen::Matrix3d::Identity()});
  optimize(graph, {});
  EXPECT_TRUE(has_implausible_residual(graph));
}

TEST(CertifiedOptimum, ProvesThePublicGraphs) {
  const std::map<std::string, double> known{{"manhattan", 3549.0368}, {"intel", 45.0047},
                                            {"MIT", 41.16327},        {"CSAIL", 40.55513},
                                            {"M3500a", 912.1150},     {"M3500b", 2054.7159}};
  for (const auto& [name, minimum] : known) {
    ADIT_RECORDING_OR_SKIP(path, "posegraph/" + name + ".g2o");
    PoseGraph graph = read_g2o(path).graph;
    optimize(graph, {});
    const Certificate certificate = certify(graph);
    EXPECT_TRUE(certificate.is_global) << name;
    EXPECT_NEAR(certificate.objective, minimum, 1e-4) << name;
  }
}

}  // namespace
}  // namespace adit
