// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "common/types/vehicle.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Whether a vehicle can pass under, over or through an obstacle on a floor at height `floor_m`:
/// the obstacle is below the belly clearance or step height, or above the vehicle height; pits, mud
/// and water are no deeper than the step, sinkage or wading limit.
bool is_passable(const Obstacle& obstacle, double floor_m, const Vehicle& vehicle);

/// Raster of the plan of one level of a mine: squares without rock and without obstacles that the
/// vehicle cannot pass. Ground outside the entrances is included.
class PassableRaster {
 public:
  static constexpr double kSide = 0.1;  ///< of a square [m]

  /// The rasters of all levels have the same squares. Throws std::invalid_argument for a plan of
  /// more than a few hundred million squares.
  PassableRaster(const WorldTruth& truth, const Vehicle& vehicle, int level = 0);

  /// Lowest corner of square (0, 0), p_world [m].
  [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Whether a square is passable. False outside of the raster.
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
  void open_ground_at(const TunnelNode& entrance, const WorldTruth& truth, int level);
  void close(const Obstacle& obstacle);

  Eigen::Vector2d origin_{0.0, 0.0};
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> squares_;  ///< row by row; 1 where passable
};

}  // namespace adit
