// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// Which point of the body moves straight ahead, and how the body turns with it.
///
/// With four-wheel steering (both axles alike, to opposite sides) that is the origin. With
/// Ackermann steering it is the middle of the rear axle: a path of the origin of radius R is one of
/// radius √(R² − (wheelbase/2)²) there.
class Steering {
 public:
  /// Throws std::invalid_argument for Ackermann steering with a turning radius of the origin of
  /// half the wheelbase or less, which has no such path.
  explicit Steering(const Vehicle& vehicle);

  /// Turn of the body for each metre along its x axis [1/m], when the path of the origin has the
  /// curvature given.
  [[nodiscard]] double turn_rad_per_m(double curvature_1_m) const;

  /// Motion of the body, in the frame that it starts from, when the point that moves ahead goes
  /// `length_m` while the body turns, `side_slip_rad` to the left of x.
  [[nodiscard]] Pose2 motion(double length_m, double turn_rad, double side_slip_rad = 0.0) const;

 private:
  double ahead_x_m_ = 0.0;  ///< of the point that moves ahead, in the body frame
};

}  // namespace adit
