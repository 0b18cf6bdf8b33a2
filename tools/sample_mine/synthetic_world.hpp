// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A piece of wall.
struct Segment {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

/// A plane world of opaque walls, in the frame `world`, with fast ray casting: the walls are sorted
/// into square cells, and a ray looks only into the cells it passes.
class SyntheticWorld {
 public:
  explicit SyntheticWorld(std::vector<Segment> walls);

  /// Distance to the first wall in a direction [rad], or nothing if none is within `range_max_m`.
  [[nodiscard]] std::optional<double> cast(const Eigen::Vector2d& p_world, double angle_rad,
                                           double range_max_m) const;
  /// Distance to the nearest wall, or nothing if none is within `radius_m`.
  [[nodiscard]] std::optional<double> clearance(const Eigen::Vector2d& p_world,
                                                double radius_m) const;

  [[nodiscard]] const std::vector<Segment>& walls() const { return walls_; }

 private:
  void sort_into_cells();
  [[nodiscard]] std::size_t index(int column, int row) const;
  [[nodiscard]] const std::vector<int>& cell(int column, int row) const;

  std::vector<Segment> walls_;
  Eigen::Vector2d corner_{0.0, 0.0};  // of cell (0, 0)
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::vector<int>> cells_;  // indices of the walls that touch each cell
};

}  // namespace adit
