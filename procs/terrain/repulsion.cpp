// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/repulsion.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {
namespace {

/// The cone, row by row from −reach to reach.
class Kernel {
 public:
  Kernel(double radius_m, double cell_m)
      : reach_(std::max(static_cast<int>(std::ceil(radius_m / cell_m)) - 1, 0)) {
    double half = 0.0;  // of a half-plane with the middle on its edge
    for (int y = -reach_; y <= reach_; ++y) {
      for (int x = -reach_; x <= reach_; ++x) {
        const double distance_m = cell_m * std::hypot(x, y);
        const double weight = distance_m == 0.0 ? 1.0 : std::max(1.0 - distance_m / radius_m, 0.0);
        weights_.push_back(static_cast<float>(weight));
        if (x >= 0) half += weight;
      }
    }
    for (float& weight : weights_) weight /= static_cast<float>(half);
  }

  [[nodiscard]] int reach() const { return reach_; }
  [[nodiscard]] const float* row(int y) const {
    const auto side = 2 * static_cast<std::size_t>(reach_) + 1;
    return weights_.data() + static_cast<std::size_t>(y + reach_) * side + reach_;
  }

 private:
  int reach_;
  std::vector<float> weights_;
};

void spread(std::vector<float>& sums, const TerrainMap& map, int column, int row,
            const Kernel& kernel) {
  const float coefficient = map.at(column, row).coefficient_m;
  const int first = std::max(column - kernel.reach(), 0);
  const int last = std::min(column + kernel.reach(), map.columns - 1);
  const int top = std::min(row + kernel.reach(), map.rows - 1);
  for (int r = std::max(row - kernel.reach(), 0); r <= top; ++r) {
    const float* weights = kernel.row(r - row) - column;
    float* out = sums.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(map.columns);
    for (int c = first; c <= last; ++c) out[c] += coefficient * weights[c];
  }
}

}  // namespace

void set_repulsion(TerrainMap& map, const RepulsionParams& params) {
  const Kernel kernel(params.radius_m, map.cell_m);
  const auto least = static_cast<float>(params.coefficient_min_m);
  std::vector<float> sums(map.cells.size(), 0.0F);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      if (map.at(column, row).coefficient_m >= least) spread(sums, map, column, row, kernel);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) map.cells[i].repulsion_m = sums[i];
}

}  // namespace adit
