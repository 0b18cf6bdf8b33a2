// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace adit {

/// x of A x = b, by the LDLᵀ factorization of a symmetric, positive or negative semidefinite A, of
/// which the lower triangle is used. Compiled once: Eigen's LDLT takes the compiler seconds in each
/// source that uses it.
Eigen::Vector2d solve_symmetric(const Eigen::Matrix2d& A, const Eigen::Vector2d& b);
Eigen::Vector3d solve_symmetric(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);
Eigen::Matrix<double, 6, 1> solve_symmetric(const Eigen::Matrix<double, 6, 6>& A,
                                            const Eigen::Matrix<double, 6, 1>& b);
Eigen::Matrix3d solve_symmetric(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B);

}  // namespace adit
