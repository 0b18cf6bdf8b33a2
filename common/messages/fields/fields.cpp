// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/fields/fields.hpp"

#include <cmath>

#include <Eigen/Core>

namespace adit {
namespace {

constexpr double kAsymmetryMax = 1e-6;  // relative; matrices result from products and inverses

/// The matrix with its diagonal scaled to one: whatever the units, its entries are from −1 to 1.
/// Rows of a zero on the diagonal become those of the identity; their entries must be zero.
Eigen::Matrix3d scaled(const Eigen::Matrix3d& matrix) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = std::sqrt(matrix(i, i)) * std::sqrt(matrix(j, j));
      if (scale > 0.0 && i != j) result(i, j) = matrix(i, j) / scale;
    }
  }
  return result;
}

/// Whether the matrix plus `rounding` on its diagonal is positive definite: its leading minors
/// (Sylvester's criterion). Requires ones on the diagonal.
bool is_semidefinite(const Eigen::Matrix3d& R, double rounding) {
  const double d = 1.0 + rounding;
  const double a = R(0, 1);
  const double b = R(0, 2);
  const double c = R(1, 2);
  const double schur_1 = d - a * a / d;
  if (!(schur_1 >= 0.0)) return false;
  const double rest = c - a * b / d;
  const double schur_2 = d - b * b / d;
  return schur_2 >= 0.0 && schur_1 * schur_2 >= rest * rest;
}

}  // namespace

bool is_plausible(const double (&rows)[3][3], const MatrixLimit& limit) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix(i, j) = rows[i][j];
  }
  if (!matrix.allFinite() || matrix.diagonal().minCoeff() < 0.0) return false;
  if (matrix.cwiseAbs().maxCoeff() > limit.diagonal_max) return false;
  if (!limit.is_definite) return true;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double bound = std::sqrt(matrix(i, i)) * std::sqrt(matrix(j, j));
      if (bound == 0.0 && (matrix(i, j) != 0.0 || matrix(j, i) != 0.0)) return false;
      if (std::abs(matrix(i, j) - matrix(j, i)) > kAsymmetryMax * bound) return false;
    }
  }
  return is_semidefinite(scaled(matrix), limit.rounding);
}

}  // namespace adit
