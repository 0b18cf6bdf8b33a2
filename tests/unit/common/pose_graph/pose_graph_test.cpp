// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include "tests/support/graphs/synthetic_graphs.hpp"

namespace adit {
namespace {

constexpr double kStep = 1e-6;
// Rounding over the step; central differences err by its square.
constexpr double kTolerance = 1e-8;

Pose2 moved(const Pose2& pose, int k, double by) {
  Eigen::Vector3d v = pose.vector();
  v[k] += by;
  return Pose2::from_vector(v);
}

class PotentialOfARandomConstraint : public testing::TestWithParam<std::uint32_t> {
 protected:
  PoseGraph graph_ = test::square_trajectory_graph(2, 5, 2.0, GetParam());
  PoseConstraint constraint_ = graph_.constraints.front();
  Pose2 from_{0.7, -3.0, 0.4 + GetParam()};
  Pose2 to_{5.0, 1.5, 2.9};
};

TEST_P(PotentialOfARandomConstraint, HasTheJacobiansOfFiniteDifferences) {
  const LinearPotential potential = linearise(constraint_, from_, to_);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d by_from = (residual(constraint_, moved(from_, k, kStep), to_) -
                                     residual(constraint_, moved(from_, k, -kStep), to_)) /
                                    (2.0 * kStep);
    const Eigen::Vector3d by_to = (residual(constraint_, from_, moved(to_, k, kStep)) -
                                   residual(constraint_, from_, moved(to_, k, -kStep))) /
                                  (2.0 * kStep);
    EXPECT_LT((potential.jacobian_from().col(k) - by_from).norm(), kTolerance);
    EXPECT_LT((potential.J_to.col(k) - by_to).norm(), kTolerance);
  }
}

TEST_P(PotentialOfARandomConstraint, HasTheSameResidualWhenLinearised) {
  const LinearPotential potential = linearise(constraint_, from_, to_);
  EXPECT_LT((potential.e - residual(constraint_, from_, to_)).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PotentialOfARandomConstraint, testing::Values(1U, 2U, 3U, 4U));

TEST(Potential, IsZeroForPosesAsMeasured) {
  const PoseConstraint constraint{0, 1, {1.0, 2.0, 0.5}, Eigen::Matrix3d::Identity()};
  const Pose2 from{3.0, -1.0, 2.0};
  EXPECT_LT(residual(constraint, from, from * constraint.T_from_to).norm(), 1e-12);
}

TEST(Potential, WrapsAngles) {
  const PoseConstraint constraint{0, 1, {0.0, 0.0, 3.1}, Eigen::Matrix3d::Identity()};
  EXPECT_NEAR(residual(constraint, {}, {0.0, 0.0, -3.1}).z(), 2.0 * 3.14159265358979 - 6.2, 1e-12);
}

TEST(Potential, ObjectiveIsTheSumWithoutTheFactorOneHalf) {
  PoseGraph graph;
  graph.poses = {{}, {2.0, 0.0, 0.0}};
  graph.constraints = {{0, 1, {1.0, 0.0, 0.0}, 3.0 * Eigen::Matrix3d::Identity()}};
  EXPECT_DOUBLE_EQ(objective(graph), 3.0);
}

}  // namespace
}  // namespace adit
