// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"
#include "sim/vehicle/vehicle_params.hpp"

namespace adit {

/// Kinematics of the steering: which point of the body moves along its x axis, and how the body
/// turns.
///
/// With symmetric four-wheel steering that point is the origin. With Ackermann steering it is the
/// middle of the rear axle: a path of the origin of radius R is one of radius √(R² −
/// (wheelbase/2)²) there.
class Steering {
 public:
  /// Throws std::invalid_argument for Ackermann steering with a turning radius of at most half the
  /// wheelbase, for which no such path exists.
  explicit Steering(const Vehicle& vehicle);

  /// Turn of the body per metre along its x axis, for a curvature of the origin's path.
  [[nodiscard]] double turn_rad_per_m(double curvature_1_m) const;

  /// Motion of the body in its initial frame: the moving point advances by `length_m` in the
  /// direction `side_slip_rad` to the left of x while the body turns.
  [[nodiscard]] Pose2 motion(double length_m, double turn_rad, double side_slip_rad = 0.0) const;

 private:
  double ahead_x_m_ = 0.0;  ///< of the moving point, in the body frame
};

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
