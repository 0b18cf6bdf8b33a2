// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Each place of a line as the mean of itself and `reach` neighbours to each side, of fewer near
/// the ends, which stay where they are.
inline std::vector<Eigen::Vector2d> smoothed(const std::vector<Eigen::Vector2d>& line, int reach) {
  const int n = static_cast<int>(line.size());
  std::vector<Eigen::Vector2d> smooth;
  for (int i = 0; i < n; ++i) {
    const int near = std::min({reach, i, n - 1 - i});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int k = i - near; k <= i + near; ++k) sum += line[static_cast<std::size_t>(k)];
    smooth.emplace_back(sum / (2 * near + 1));
  }
  return smooth;
}

}  // namespace adit
