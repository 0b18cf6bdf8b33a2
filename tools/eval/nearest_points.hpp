// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// Points of the plane in the cells of a grid, to be asked for the nearest.
class NearestPoints {
 public:
  /// Distances up to `max_distance_m` will be asked for.
  NearestPoints(const std::vector<Eigen::Vector2d>& points, double max_distance_m);

  /// Infinite where no point lies within reach. [m]
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p) const;

 private:
  using Cell = std::pair<int, int>;

  [[nodiscard]] Cell cell_at(const Eigen::Vector2d& p) const;

  double max_distance_m_;
  std::vector<std::pair<Cell, Eigen::Vector2d>> points_;  // by cell, ascending
};

/// One point for each cell of a grid of that spacing that has any: the first of them.
std::vector<Eigen::Vector2d> downsampled(const std::vector<Eigen::Vector2d>& points,
                                         double spacing_m);

}  // namespace adit
