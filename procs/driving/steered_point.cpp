// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/steered_point.hpp"

#include <cmath>
#include <stdexcept>

namespace adit {

SteeredPoint::SteeredPoint(const Vehicle& vehicle)
    : curvature_max_1_m_(1.0 / vehicle.turning_radius_m) {
  if (vehicle.steering != "ackermann") return;
  x_m_ = -0.5 * vehicle.wheelbase_m;
  if (vehicle.turning_radius_m <= -x_m_) {
    throw std::invalid_argument(
        "the turning radius is at most half the wheelbase, which Ackermann steering cannot do");
  }
  curvature_max_1_m_ =
      1.0 / std::sqrt(vehicle.turning_radius_m * vehicle.turning_radius_m - x_m_ * x_m_);
}

Pose2 SteeredPoint::pose(const Pose2& T_odom_body) const {
  return T_odom_body * Pose2{x_m_, 0.0, 0.0};
}

double SteeredPoint::curvature_of_origin(double curvature_1_m) const {
  return curvature_1_m / std::hypot(1.0, x_m_ * curvature_1_m);
}

}  // namespace adit
