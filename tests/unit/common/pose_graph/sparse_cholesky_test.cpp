// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/pose_graph/sparse_cholesky.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "common/pose_graph/normal_equations.hpp"
#include "tests/support/graphs/synthetic_graphs.hpp"
#include "tests/unit/common/pose_graph/dense.hpp"

namespace adit {
namespace {

constexpr double kTolerance = 1e-9;  // relative; the condition number is about 1e5

class SparseCholeskyOfAField : public testing::Test {
 protected:
  SparseCholeskyOfAField() { equations_.linearise(graph_); }
  SparseCholesky& sparse() { return equations_.matrix(); }

  PoseGraph graph_ = test::square_trajectory_graph(60, 5, 0.1);
  NormalEquations equations_{analyse(graph_)};
  test::DenseField dense_{graph_};
};

TEST_F(SparseCholeskyOfAField, SolvesAsTheDenseMatrixDoes) {
  ASSERT_TRUE(sparse().factorise());
  EXPECT_TRUE(sparse().solve(dense_.b).isApprox(dense_.H.inverse() * dense_.b, kTolerance));
  EXPECT_TRUE(equations_.b().isApprox(dense_.b, kTolerance));
}

TEST_F(SparseCholeskyOfAField, FactorisesAgainWithTheSameResult) {
  ASSERT_TRUE(sparse().factorise());
  const Eigen::VectorXd first = sparse().solve(dense_.b);
  ASSERT_TRUE(sparse().factorise());
  EXPECT_EQ(sparse().solve(dense_.b), first);
}

TEST_F(SparseCholeskyOfAField, ComputesTheDiagonalOfTheInverse) {
  ASSERT_TRUE(sparse().factorise());
  const Eigen::MatrixXd inverse = dense_.H.inverse();
  const auto diagonal = sparse().inverse_diagonal();
  ASSERT_EQ(diagonal.size(), 59U);
  for (Eigen::Index i = 0; i < 59; ++i) {
    EXPECT_TRUE(diagonal[static_cast<std::size_t>(i)].isApprox(inverse.block<3, 3>(3 * i, 3 * i),
                                                               kTolerance));
  }
}

TEST_F(SparseCholeskyOfAField, ComputesColumnsAndSubmatricesOfTheInverse) {
  ASSERT_TRUE(sparse().factorise());
  const Eigen::MatrixXd inverse = dense_.H.inverse();
  EXPECT_TRUE(sparse().inverse_columns(17).isApprox(inverse.middleCols<3>(51), kTolerance));
  const Eigen::MatrixXd part = sparse().inverse_among({40, 3});
  EXPECT_TRUE((part.block<3, 3>(0, 0).isApprox(inverse.block<3, 3>(120, 120), kTolerance)));
  EXPECT_TRUE((part.block<3, 3>(0, 3).isApprox(inverse.block<3, 3>(120, 9), kTolerance)));
  EXPECT_TRUE((part.block<3, 3>(3, 3).isApprox(inverse.block<3, 3>(9, 9), kTolerance)));
}

TEST_F(SparseCholeskyOfAField, UpdatesBetweenBlocksThatWereNotLinked) {
  ASSERT_TRUE(sparse().factorise());
  const Eigen::MatrixXd C = 10.0 * Eigen::MatrixXd::Random(6, 3);
  ASSERT_TRUE(sparse().update({50, 2}, C));
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(dense_.H.rows(), 3);
  full.middleRows<3>(150) = C.topRows<3>();
  full.middleRows<3>(6) = C.bottomRows<3>();
  const Eigen::MatrixXd inverse = (dense_.H + full * full.transpose()).inverse();
  EXPECT_TRUE(sparse().solve(dense_.b).isApprox(inverse * dense_.b, kTolerance));
  EXPECT_TRUE(sparse().inverse_diagonal()[30].isApprox(inverse.block<3, 3>(90, 90), kTolerance));
  ASSERT_TRUE(sparse().downdate({50, 2}, C));
  EXPECT_TRUE(sparse().solve(dense_.b).isApprox(dense_.H.inverse() * dense_.b, kTolerance));
}

TEST_F(SparseCholeskyOfAField, DiscardsUpdatesWhenItFactorisesAgain) {
  ASSERT_TRUE(sparse().factorise());
  ASSERT_TRUE(sparse().update({50, 2}, Eigen::MatrixXd::Ones(6, 3)));
  ASSERT_TRUE(sparse().factorise());
  EXPECT_TRUE(sparse().solve(dense_.b).isApprox(dense_.H.inverse() * dense_.b, kTolerance));
}

TEST_F(SparseCholeskyOfAField, ReportsADowndateThatIsNotPositiveDefinite) {
  ASSERT_TRUE(sparse().factorise());
  EXPECT_FALSE(sparse().downdate({58}, 1e4 * Eigen::MatrixXd::Identity(3, 3)));
  EXPECT_FALSE(sparse().has_factor());
}

TEST(SparseCholesky, ReportsTheBlockOfASingularMatrix) {
  const BlockPattern pattern{3, {{0, 1}}};
  SparseCholesky A(pattern, order_blocks(pattern), 1);
  using Scalar = Eigen::Matrix<double, 1, 1>;
  A.add_to_diagonal<1>(0, Scalar(2.0));
  A.add_to_diagonal<1>(1, Scalar(2.0));
  A.add_to_pair<1>(0, Scalar(-1.0));
  EXPECT_FALSE(A.factorise());
  EXPECT_EQ(A.weakest_block(), 2);
  A.add_to_diagonal<1>(2, Scalar(1.0));
  EXPECT_TRUE(A.factorise());
}

TEST(SparseCholesky, ReportsAnIndefiniteMatrix) {
  const BlockPattern pattern{2, {{1, 0}}};
  SparseCholesky A(pattern, order_blocks(pattern), 3);
  A.add_to_diagonal<3>(0, Eigen::Matrix3d::Identity());
  A.add_to_diagonal<3>(1, Eigen::Matrix3d::Identity());
  A.add_to_pair<3>(0, 2.0 * Eigen::Matrix3d::Identity());
  EXPECT_FALSE(A.factorise());
}

TEST(SparseCholesky, DistinguishesThePairFromItsTranspose) {
  const BlockPattern pattern{2, {{1, 0}}};
  SparseCholesky A(pattern, order_blocks(pattern), 3);
  Eigen::MatrixXd dense = 9.0 * Eigen::MatrixXd::Identity(6, 6);
  Eigen::Matrix3d M;
  M << 1, 2, 3, 0, 1, 0, 4, 0, 1;
  dense.block<3, 3>(3, 0) = M;
  dense.block<3, 3>(0, 3) = M.transpose();
  for (int i = 0; i < 2; ++i) A.add_to_diagonal<3>(i, 9.0 * Eigen::Matrix3d::Identity());
  A.add_to_pair<3>(0, M);
  ASSERT_TRUE(A.factorise());
  EXPECT_TRUE(A.inverse_columns(0).isApprox(dense.inverse().leftCols<3>(), 1e-12));
}

}  // namespace
}  // namespace adit
