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

/// Everything in a world that a laser near the ground can meet and a plan should show, seen from
/// above: what reaches into the heights from 0.1 to 2 m above the floor, but for water, rails,
/// sleepers, and those parts of floor and roof that are not steep (less than 60° against the
/// level). Frame world.
class WorldWalls {
 public:
  /// Distances up to `max_distance_m` will be asked for. `world` must outlive this.
  WorldWalls(const World& world, double max_distance_m);

  [[nodiscard]] bool is_wall(std::uint32_t triangle) const { return is_wall_[triangle]; }

  /// To the nearest, 0 within the outline of one; infinite where none lies within reach. [m]
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_world) const;

 private:
  using Cell = std::pair<int, int>;
  using Outline = std::array<Eigen::Vector2d, 3>;  // a triangle seen from above

  [[nodiscard]] int cell_of(double coordinate) const;
  void add_to_cells(std::uint32_t index);

  double max_distance_m_;
  std::vector<bool> is_wall_;
  std::vector<Outline> outlines_;
  std::vector<std::pair<Cell, std::uint32_t>> cells_;  // with indices into outlines_, ascending
};

}  // namespace adit
