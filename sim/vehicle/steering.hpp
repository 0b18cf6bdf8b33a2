// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/geometry/pose2.hpp"
#include "common/types/vehicle.hpp"

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

}  // namespace adit
