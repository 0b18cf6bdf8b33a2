// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/planar_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

bool is_information_matrix(const double (&rows)[3][3]) {
  constexpr double kRounding = 1e-6;  // relative; matrices result from products and inverses
  for (int i = 0; i < 3; ++i) {
    if (!all_finite(rows[i]) || rows[i][i] < 0.0) return false;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double bound = std::sqrt(rows[i][i]) * std::sqrt(rows[j][j]);
      if (std::abs(rows[i][j]) > (1.0 + kRounding) * bound) return false;
      if (std::abs(rows[i][j] - rows[j][i]) > kRounding * bound) return false;
    }
  }
  return true;
}

}  // namespace adit
