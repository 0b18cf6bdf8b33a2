// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/sensing/spinning_lidar.hpp"
#include "tools/check_driver/check_result.hpp"

namespace adit {

/// What the checks need of a revolution of a spinning lidar.
struct LidarTurn {
  double turned_rad = 0.0;             ///< from the first column to the last, counter-clockwise
  double backwards_share = 0.0;        ///< of its steps that go against most of the others
  double step_rad = 0.0;               ///< the usual one between two columns
  std::vector<double> elevations_rad;  ///< of the rings
  std::size_t readings = 0;
  std::size_t missing = 0;  ///< of the readings: not measured
  std::size_t returns = 0;  ///< of the readings
  double nearest_m = 0.0;   ///< of the returns; 0 without one
  double farthest_m = 0.0;
  double below_m = 0.0;  ///< median range of the lowest ring; 0 without returns
  double above_m = 0.0;  ///< of the highest
  std::size_t hash = 0;  ///< of the ranges

  explicit LidarTurn(const LidarRevolution& revolution);
};

/// Checks that revolutions are whole turns of one direction, rings, returns, ranges, which end is
/// up, and repetition; there is at least one.
CheckResults check_lidar(const std::vector<LidarTurn>& turns);

}  // namespace adit
