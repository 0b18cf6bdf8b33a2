// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/cell_heights.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace adit {
namespace {

constexpr float kReachMax = 1000.0F;  // [m]

/// The cell of each point, in the order of the cloud.
std::vector<int> cells_of(const Cloud& cloud, const CellFinder& finder) {
  std::vector<int> cells;
  cells.reserve(cloud.points());
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      cells.push_back(is_usable(p) ? finder.at(p.x(), p.y()) : CellFinder::kOutside);
    }
  }
  return cells;
}

}  // namespace

bool is_usable(const Eigen::Vector3f& p_level) {
  return (p_level.array().abs() <= kReachMax).all();  // false for NaN
}

std::size_t unusable_points(const Cloud& cloud) {
  std::size_t n = 0;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) n += is_usable(p) ? 0U : 1U;
    for (const Eigen::Vector3f& miss : line.misses) n += is_usable(miss) ? 0U : 1U;
  }
  return n;
}

CellHeights::CellHeights(const Cloud& cloud, const TerrainMap& map)
    : lowest_m_(map.cells.box(), std::numeric_limits<float>::infinity()),
      starts_(map.cells.size() + 1, 0) {
  const std::vector<int> cells = cells_of(cloud, CellFinder(map));
  for (const int cell : cells) {
    if (cell != CellFinder::kOutside) ++starts_[static_cast<std::size_t>(cell) + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  heights_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  std::size_t i = 0;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const int cell_or_none = cells[i++];
      if (cell_or_none == CellFinder::kOutside) continue;
      const auto cell = static_cast<std::size_t>(cell_or_none);
      heights_[next[cell]++] = p.z();
      lowest_m_[cell] = std::min(lowest_m_[cell], p.z());
    }
  }
}

}  // namespace adit
