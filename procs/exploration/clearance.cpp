// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {
namespace {

constexpr int kFar = 1 << 20;  // cells

/// Squares of the distance along each column, by two sweeps.
std::vector<int> along_columns(const CellField<Known>& known) {
  const auto columns = static_cast<std::size_t>(known.box().size().x());
  std::vector<int> distance(known.size(), kFar);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == Known::kWall) {
      distance[i] = 0;
    } else if (i >= columns) {
      distance[i] = std::min(kFar, distance[i - columns] + 1);
    }
  }
  for (std::size_t i = known.size(); i-- > 0;) {
    if (i + columns < known.size()) distance[i] = std::min(distance[i], distance[i + columns] + 1);
  }
  return distance;
}

}  // namespace

CellField<float> wall_clearance(const CellField<Known>& known, double resolution_m,
                                double largest_m) {
  CellField<float> clearance(known.box());
  const std::vector<int> columns_m = along_columns(known);
  const int n = known.box().size().x();
  const int reach = static_cast<int>(std::ceil(largest_m / resolution_m));
  for (std::size_t row = 0; row < known.size(); row += static_cast<std::size_t>(n)) {
    const int* distance = &columns_m[row];
    for (int x = 0; x < n; ++x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      if (known[i] == Known::kUnseen || known[i] == Known::kWall) continue;
      int best = std::min(distance[x], reach);
      best *= best;
      for (int off = 1; off < reach && off * off < best; ++off) {
        for (const int at : {x - off, x + off}) {
          if (at < 0 || at >= n || distance[at] >= reach) continue;
          best = std::min(best, off * off + distance[at] * distance[at]);
        }
      }
      clearance[i] = static_cast<float>(resolution_m * std::sqrt(static_cast<double>(best)));
    }
  }
  return clearance;
}

}  // namespace adit
