// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/symmetric_solve.hpp"

#include <Eigen/Cholesky>

namespace adit {

Eigen::Vector2d solve_symmetric(const Eigen::Matrix2d& A, const Eigen::Vector2d& b) {
  return A.ldlt().solve(b);
}

Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) {
  return A.ldlt().solve(b);
}

Eigen::Matrix<double, 6, 1> solve_symmetric(const Eigen::Matrix<double, 6, 6>& A,
                                            const Eigen::Matrix<double, 6, 1>& b) {
  return A.ldlt().solve(b);
}

Eigen::Matrix3d solve_symmetric(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  return A.ldlt().solve(B);
}

}  // namespace adit
