// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/points/thinned_points.hpp"

#include <utility>

namespace adit {

void ThinnedPoints::add(const ComparedPoint& point) {
  if (!take(point)) return;
  points_.push_back(point);
  while (points_.size() > points_max_) {
    voxel_m_ *= 2.0;
    taken_.clear();
    std::erase_if(points_, [&](const ComparedPoint& at) { return !take(at); });
  }
}

std::vector<ComparedPoint> ThinnedPoints::release() && { return std::move(points_); }

bool ThinnedPoints::take(const ComparedPoint& point) {
  return taken_.insert(voxel_key(Eigen::Vector3d(point.p.cast<double>()), voxel_m_)).second;
}

}  // namespace adit
