// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// How the way over ground departs from that of the wheels: an Ornstein-Uhlenbeck process in
/// distance, correlated over a metre (Gillespie, "Exact numerical simulation of the
/// Ornstein-Uhlenbeck process and its integral", 1996, eq. 1.9). More on soft ground.
class WheelSlip {
 public:
  WheelSlip(const VehicleModelParams& params, std::uint64_t seed);

  /// The wheels go on by a distance, to either side [m].
  void advance(double distance_m);

  /// Share of the way that is lost, 0 to 0.9. `softness` is 0 on firm ground and 1 where the wheels
  /// sink as deep as they may.
  [[nodiscard]] double slip_ratio(double softness) const;
  /// Direction of motion against the steering, positive to the left [rad].
  [[nodiscard]] double side_slip_rad(double softness) const;

 private:
  VehicleModelParams params_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double lost_ = 0.0;  ///< standard normal
  double side_ = 0.0;  ///< standard normal
};

}  // namespace adit
