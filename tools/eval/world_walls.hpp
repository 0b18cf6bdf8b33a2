// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "sim/world/world.hpp"

namespace adit {

/// The walls of a world in 2D, as a map should show them: all surfaces between 0.1 and 2 m above
/// the floor, except for water, rails, sleepers, and parts of floor and roof with a slope below
/// 60°. Frame world.
class WorldWalls {
 public:
  /// Distances are searched up to `max_distance_m`. `world` must outlive this.
  WorldWalls(const World& world, double max_distance_m);

  [[nodiscard]] bool is_wall(std::uint32_t triangle) const { return is_wall_[triangle]; }

  /// Distance to the nearest wall, 0 within an outline; infinite if it is more than the maximum.
  /// [m]
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_world) const;

 private:
  using Cell = std::pair<int, int>;
  using Outline = std::array<Eigen::Vector2d, 3>;  // a triangle in 2D

  [[nodiscard]] int cell_of(double coordinate) const;
  void add_to_cells(std::uint32_t index);

  double max_distance_m_;
  std::vector<bool> is_wall_;
  std::vector<Outline> outlines_;
  std::vector<std::pair<Cell, std::uint32_t>> cells_;  // with indices into outlines_, sorted
};

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
