// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/gaussian_field.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/unit/common/pose_graph/dense.hpp"

namespace adit {
namespace {

constexpr double kTolerance = 1e-8;  // relative; the condition number is about 1e5

class FieldOfASquareWalk : public testing::Test {
 protected:
  [[nodiscard]] Eigen::Matrix3d dense_covariance(int from, int to) const {
    const Eigen::MatrixXd inverse = test::DenseField(graph_).H.inverse();
    const LinearPotential p =
        linearise(PoseConstraint{}, graph_.poses[std::size_t(from)], graph_.poses[std::size_t(to)]);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, inverse.rows());
    if (from > 0) J.middleCols<3>(row_of(from)) = p.jacobian_from();
    if (to > 0) J.middleCols<3>(row_of(to)) = p.J_to;
    return J * inverse * J.transpose();
  }

  /// Not among those of the graph; node 47 is at the place of 7 and 27.
  [[nodiscard]] PoseConstraint loop() const {
    return {47, 7, {0.3, -0.2, 0.05}, graph_.constraints.front().information};
  }

  PoseGraph graph_ = test::square_trajectory_graph(60, 5, 0.1);
};

TEST_F(FieldOfASquareWalk, HasTheModeOfTheDenseField) {
  const GaussianField field(graph_);
  const test::DenseField dense(graph_);
  const Eigen::VectorXd mode = dense.H.inverse() * dense.b;
  EXPECT_TRUE(field.mode().isApprox(mode, kTolerance));
  EXPECT_NEAR(field.objective(), dense.constant - mode.dot(dense.b), kTolerance * dense.constant);
}

TEST_F(FieldOfASquareWalk, AddingEqualsAFieldWithTheConstraint) {
  GaussianField field(graph_);
  field.add(loop());
  graph_.constraints.push_back(loop());
  const GaussianField expected(graph_);
  EXPECT_TRUE(field.mode().isApprox(expected.mode(), kTolerance));
  EXPECT_NEAR(field.objective(), expected.objective(), kTolerance * expected.objective());
}

TEST_F(FieldOfASquareWalk, RemovingAnAddedConstraintRestoresTheField) {
  GaussianField field(graph_);
  const Eigen::VectorXd mode = field.mode();
  const double objective = field.objective();
  field.add(loop());
  EXPECT_GT((field.mode() - mode).norm(), 1e-3);
  ASSERT_TRUE(field.remove(loop()));
  EXPECT_TRUE(field.mode().isApprox(mode, kTolerance));
  EXPECT_NEAR(field.objective(), objective, kTolerance * objective);
}

TEST_F(FieldOfASquareWalk, RemovesAConstraintOfTheGraph) {
  GaussianField field(graph_);
  const PoseConstraint removed = graph_.constraints.back();
  ASSERT_TRUE(field.remove(removed));
  graph_.constraints.pop_back();
  const GaussianField without(graph_);
  EXPECT_TRUE(field.mode().isApprox(without.mode(), kTolerance));
}

TEST_F(FieldOfASquareWalk, RejectsRemovalThatDisconnectsThePoses) {
  graph_ = test::square_trajectory_graph(10, 5, 0.1);  // no loop
  GaussianField field(graph_);
  const Eigen::VectorXd mode = field.mode();
  EXPECT_FALSE(field.remove(graph_.constraints[4]));
  EXPECT_EQ(field.mode(), mode);
}

TEST_F(FieldOfASquareWalk, PredictsTheIncreaseOfTheObjective) {
  GaussianField field(graph_);
  for (const PoseConstraint& c :
       {loop(), PoseConstraint{0, 33, {1.0, 2.0, 0.3}, loop().information}}) {
    const double before = field.objective();
    const double increase = field.objective_increase(c);
    field.add(c);
    EXPECT_NEAR(field.objective() - before, increase, kTolerance * field.objective());
  }
}

TEST_F(FieldOfASquareWalk, PredictsTheIncreaseForSingularInformation) {
  GaussianField field(graph_);
  PoseConstraint along_a_tunnel = loop();
  along_a_tunnel.information = Eigen::Vector3d(0.0, 400.0, 4000.0).asDiagonal();
  const double before = field.objective();
  const double increase = field.objective_increase(along_a_tunnel);
  field.add(along_a_tunnel);
  EXPECT_NEAR(field.objective() - before, increase, kTolerance * field.objective());
}

TEST_F(FieldOfASquareWalk, HasTheRelativeCovariancesOfTheDenseInverse) {
  const GaussianField field(graph_);
  for (const int to : {0, 12, 59}) {
    const auto all = field.relative_covariances_to(to);
    ASSERT_EQ(all.size(), graph_.poses.size());
    for (const int from : {0, 1, 12, 30, 59}) {
      if (from == to) continue;
      const Eigen::Matrix3d expected = dense_covariance(from, to);
      EXPECT_TRUE(field.relative_covariance(from, to).isApprox(expected, kTolerance));
      EXPECT_TRUE(all[std::size_t(from)].isApprox(expected, kTolerance));
    }
    EXPECT_TRUE(all[std::size_t(to)].isZero());
  }
}

TEST(GaussianField, HasTheCovarianceOfASingleConstraint) {
  PoseGraph graph = test::square_trajectory_graph(2, 5, 0.0);
  const GaussianField field(graph);
  const Eigen::Matrix3d covariance = graph.constraints.front().information.inverse();
  // Expressed in the frame of `from`; the step is straight ahead.
  EXPECT_TRUE(field.relative_covariance(0, 1).isApprox(covariance, kTolerance));
}

TEST(GaussianField, RejectsADisconnectedGraph) {
  PoseGraph graph = test::square_trajectory_graph(10, 5, 0.1);
  graph.constraints.erase(graph.constraints.begin() + 4);
  EXPECT_THROW(GaussianField{graph}, std::runtime_error);
}

}  // namespace
}  // namespace adit
