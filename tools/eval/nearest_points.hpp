// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// 2D points in the cells of a grid, for searches of the nearest point.
class NearestPoints {
 public:
  /// Distances are searched up to `max_distance_m`.
  NearestPoints(const std::vector<Eigen::Vector2d>& points, double max_distance_m);

  /// Distance to the nearest point; infinite if it is more than the maximum. [m]
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p) const;

 private:
  using Cell = std::pair<int, int>;

  [[nodiscard]] Cell cell_at(const Eigen::Vector2d& p) const;

  double max_distance_m_;
  std::vector<std::pair<Cell, Eigen::Vector2d>> points_;  // sorted by cell
};

/// The first point in each cell of a grid with that spacing.
std::vector<Eigen::Vector2d> downsampled(const std::vector<Eigen::Vector2d>& points,
                                         double spacing_m);

}  // namespace adit
