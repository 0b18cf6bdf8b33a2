// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/points/point_index.hpp"

namespace adit {

/// Of many points the first one in each cube. The cubes double when there are too many, so that
/// neither memory nor the work that follows grows with the mine.
class ThinnedPoints {
 public:
  /// `voxel_m`: side of a cube in the beginning; `points_max` > 0.
  ThinnedPoints(double voxel_m, std::size_t points_max)
      : voxel_m_(voxel_m), points_max_(points_max) {}

  void add(const ComparedPoint& point);

  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  /// In the order in which they were added.
  [[nodiscard]] std::vector<ComparedPoint> release() &&;

 private:
  /// Whether the point is the first one in its cube.
  bool take(const ComparedPoint& point);

  double voxel_m_;
  std::size_t points_max_;
  std::vector<ComparedPoint> points_;
  std::unordered_set<std::uint64_t> taken_;
};

}  // namespace adit
