// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/region_heights.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace adit {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The three least values of a sequence, in order.
class Least {
 public:
  void add(float z) {
    if (z >= least_[2]) return;
    least_[2] = std::max(z, least_[1]);
    least_[1] = std::clamp(z, least_[0], least_[1]);
    least_[0] = std::min(z, least_[0]);
  }
  [[nodiscard]] float at(int rank) const { return least_[static_cast<std::size_t>(rank - 1)]; }

 private:
  std::array<float, 3> least_{kInfinity, kInfinity, kInfinity};
};

}  // namespace

RegionHeights::RegionHeights(const CellHeights& heights, const TerrainMap& map,
                             const TerrainParams& params)
    : heights_(heights),
      columns_(map.cells.columns()),
      rows_(map.cells.rows()),
      headroom_m_(static_cast<float>(params.headroom_m())),
      k_(params.estimator.kind == "paper" ? 1 : params.estimator.k),
      points_per_rank_(params.estimator.points_per_rank) {}

RegionHeights::Extent RegionHeights::extent(int column, int row) const {
  return {std::max(column - 1, 0), std::min(column + 1, columns_ - 1), std::max(row - 1, 0),
          std::min(row + 1, rows_ - 1)};
}

template <class Visit>
void RegionHeights::visit_cells(int column, int row, const Visit& visit) const {
  const Extent region = extent(column, row);
  const Eigen::Vector2f& rise_m = heights_.trend().rise_m(column, row);
  for (int r = region.bottom; r <= region.top; ++r) {
    for (int c = region.left; c <= region.right; ++c) {
      visit(c, r,
            rise_m.x() * static_cast<float>(c - column) + rise_m.y() * static_cast<float>(r - row));
    }
  }
}

template <class Visit>
void RegionHeights::visit(int column, int row, const Visit& visit) const {
  visit_cells(column, row, [&](int c, int r, float rise_m) {
    for (const float z : heights_.in(c, r)) visit(z - rise_m);
  });
}

float RegionHeights::least_m(int column, int row) const {
  float least = kInfinity;
  visit_cells(column, row, [&](int c, int r, float rise_m) {
    least = std::min(least, heights_.lowest_m(c, r) - rise_m);
  });
  return least;
}

int RegionHeights::rank(std::uint32_t count) const {
  const auto supported = static_cast<int>(count) / points_per_rank_;
  return std::clamp(supported, 1, k_);
}

float RegionHeights::low_m(int column, int row) const {
  const float least = least_m(column, row);
  if (least == kInfinity) return std::numeric_limits<float>::quiet_NaN();
  // Points of the roof do not support the lowest height.
  const float limit = least + headroom_m_;
  Least lowest;
  std::uint32_t count = 0;
  visit(column, row, [&](float z) {
    lowest.add(z);
    count += z <= limit ? 1U : 0U;
  });
  return lowest.at(rank(count));
}

RegionHeights::Above RegionHeights::above(int column, int row, float ground_m) const {
  const float limit = ground_m + headroom_m_;
  Above above{ground_m, kInfinity, 0};
  Least highest;  // of the negated heights
  Least roof;
  std::uint32_t roof_count = 0;
  visit(column, row, [&](float z) {
    if (z <= limit) {
      highest.add(-z);
      ++above.count;
    } else {
      roof.add(z);
      ++roof_count;
    }
  });
  above.roof_m = roof.at(rank(roof_count));
  if (above.count > 0) above.high_m = std::max(ground_m, -highest.at(rank(above.count)));
  return above;
}

}  // namespace adit
