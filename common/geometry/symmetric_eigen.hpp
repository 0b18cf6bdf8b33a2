// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace adit {

/// Eigenvalues, increasing, and unit eigenvectors, as columns, of a symmetric matrix.
template <int kSize>
struct SymmetricEigen {
  Eigen::Matrix<double, kSize, 1> values;
  Eigen::Matrix<double, kSize, kSize> vectors;
};

/// The eigendecomposition of a symmetric matrix, of which the lower triangle is used. Compiled
/// once: Eigen's solver takes the compiler several seconds in each source that uses it.
SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d& matrix);
SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d& matrix);
SymmetricEigen<6> symmetric_eigen(const Eigen::Matrix<double, 6, 6>& matrix);

}  // namespace adit
