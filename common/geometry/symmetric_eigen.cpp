// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace adit {

SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace adit
