// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/steering.hpp"

#include <cmath>
#include <stdexcept>

namespace adit {

Steering::Steering(const Vehicle& vehicle) {
  if (vehicle.steering != "ackermann") return;
  ahead_x_m_ = -0.5 * vehicle.wheelbase_m;
  if (vehicle.turning_radius_m <= 0.5 * vehicle.wheelbase_m) {
    throw std::invalid_argument(
        "with Ackermann steering the turning radius must exceed half the wheelbase");
  }
}

double Steering::turn_rad_per_m(double curvature_1_m) const {
  const double s = curvature_1_m * ahead_x_m_;
  return curvature_1_m / std::sqrt(1.0 - s * s);
}

Pose2 Steering::motion(double length_m, double turn_rad, double side_slip_rad) const {
  const Pose2 T_body_ahead{ahead_x_m_, 0.0, side_slip_rad};
  return T_body_ahead * along_arc(length_m, turn_rad) * T_body_ahead.inverse();
}

}  // namespace adit
