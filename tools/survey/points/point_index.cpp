// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/points/point_index.hpp"

#include <algorithm>

namespace adit {

PointIndex::PointIndex(std::vector<ComparedPoint> points, double cell_m)
    : cell_m_(cell_m), points_(std::move(points)) {
  const auto key = [&](const ComparedPoint& point) {
    return voxel_key(Eigen::Vector3d(point.p.cast<double>()), cell_m_);
  };
  std::ranges::stable_sort(points_, {}, key);
  for (std::size_t first = 0; first < points_.size();) {
    std::size_t last = first + 1;
    while (last < points_.size() && key(points_[last]) == key(points_[first])) ++last;
    range_of_.emplace(key(points_[first]), std::pair(first, last));
    first = last;
  }
}

}  // namespace adit
