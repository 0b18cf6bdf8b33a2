// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Whether a vehicle could pass under, over or through an obstacle on this floor: no higher than
/// its belly or what its wheels climb, no lower than its top; no deeper than it may fall, sink or
/// wade.
bool is_passable(const Obstacle& obstacle, double floor_m, const Vehicle& vehicle);

/// The plan of a mine in squares: which of them have no rock and nothing in the way of a vehicle.
/// In front of entrances the ground belongs to it.
class PassableRaster {
 public:
  static constexpr double kSide = 0.1;  ///< of a square [m]

  /// Throws std::invalid_argument for a plan of more than a few hundred million squares.
  PassableRaster(const WorldTruth& truth, const Vehicle& vehicle);

  /// Squares count from here along x and y [m].
  [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// False outside.
  [[nodiscard]] bool at(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
           squares_[index(column, row)] != 0;
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] Eigen::Vector2d middle(int column, int row) const {
    return origin_ + kSide * Eigen::Vector2d(column + 0.5, row + 0.5);
  }
  template <class Visit>
  void visit_squares(const Eigen::AlignedBox2d& box, const Visit& visit);
  void open(const std::vector<PlanRing>& plan);
  void open_ground_at(const TunnelNode& entrance, const WorldTruth& truth);
  void close(const Obstacle& obstacle);

  Eigen::Vector2d origin_{0.0, 0.0};
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> squares_;  ///< row by row; 1 where passable
};

}  // namespace adit
