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

/// Visits the points that lie in a cell, with the index of the cell.
template <class Visit>
void visit_points(const Cloud& cloud, const std::vector<int>& cells, const Visit& visit) {
  std::size_t i = 0;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const int cell = cells[i++];
      if (cell != CellFinder::kOutside) visit(p, static_cast<std::size_t>(cell));
    }
  }
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
  visit_points(cloud, cells, [&](const Eigen::Vector3f& p, std::size_t cell) {
    ++starts_[cell + 1];
    lowest_m_[cell] = std::min(lowest_m_[cell], p.z());
  });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  heights_.resize(starts_.back());
  trend_ = GroundTrend(lowest_m_, map.cell_m);
  std::ranges::fill(lowest_m_, std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  const auto cells_per_m = static_cast<float>(1.0 / map.cell_m);
  visit_points(cloud, cells, [&](const Eigen::Vector3f& p, std::size_t cell) {
    const Eigen::Vector2i at = map.cells.cell(cell);
    const Eigen::Vector2f from_centre = p.head<2>() - map.centre(at.x(), at.y()).cast<float>();
    const float z = p.z() - cells_per_m * trend_.rise_m(cell).dot(from_centre);
    heights_[next[cell]++] = z;
    lowest_m_[cell] = std::min(lowest_m_[cell], z);
  });
}

}  // namespace adit
