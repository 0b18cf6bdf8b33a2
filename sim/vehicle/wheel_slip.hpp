// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Deviation of the motion over ground from that of the wheels: an Ornstein-Uhlenbeck process in
/// distance with a correlation length of 1 m (Gillespie, "Exact numerical simulation of the
/// Ornstein-Uhlenbeck process and its integral", 1996, eq. 1.9). It increases on soft ground.
class WheelSlip {
 public:
  WheelSlip(const VehicleModelParams& params, std::uint64_t seed);

  /// Advances the process by a distance that the wheels roll, of either sign [m].
  void advance(double distance_m);

  /// Fraction of the distance lost, 0 to 0.9. `softness` is 0 on firm ground and 1 at the maximum
  /// sinkage.
  [[nodiscard]] double slip_ratio(double softness) const;
  /// Direction of motion relative to the steering, positive to the left.
  [[nodiscard]] double side_slip_rad(double softness) const;

 private:
  VehicleModelParams params_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double lost_ = 0.0;  ///< standard normal
  double side_ = 0.0;  ///< standard normal
};

}  // namespace adit
