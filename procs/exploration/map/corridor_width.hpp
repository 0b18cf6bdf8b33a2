// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "procs/exploration/map/drivable_space.hpp"

namespace adit {

/// Measures corridors from wall to wall. A post, a prop or a car in the corridor is not its wall:
/// what stands free, surrounded by observed space, and is small (kStandsFreeMaxM) does not count.
class CorridorWidth {
 public:
  /// Largest side of the bounding box of what stands free [m]; pillars of rock are larger.
  static constexpr double kStandsFreeMaxM = 1.2;

  /// `space` must outlive this.
  explicit CorridorWidth(const DrivableSpace& space);

  /// The median over the line of the distance between the walls to its left and its right, measured
  /// across it [m]; nothing if nowhere both are known. `points`: polyline in atlas.
  [[nodiscard]] std::optional<double> of(const std::vector<Eigen::Vector2d>& points) const;

 private:
  [[nodiscard]] std::optional<double> to_wall(const Eigen::Vector2d& p,
                                              const Eigen::Vector2d& direction) const;

  const DrivableSpace& space_;
  Grid2<std::uint8_t> walls_;  ///< 1 for the walls that count
};

}  // namespace adit
