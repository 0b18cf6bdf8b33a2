// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace adit {
namespace {

constexpr double kCorrelationM = 1.0;
constexpr double kLostMax = 0.9;
constexpr double kLostInSoftGround =
    0.4;  // in addition to that on firm ground, at the maximum sinkage
constexpr double kSideInSoftGround =
    3.0;  // additional factor relative to firm ground, at the maximum sinkage

}  // namespace

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

WheelSlip::WheelSlip(const VehicleModelParams& params, std::uint64_t seed)
    : params_(params), random_(seed) {
  lost_ = normal_(random_);
  side_ = normal_(random_);
}

void WheelSlip::advance(double distance_m) {
  const double kept = std::exp(-std::abs(distance_m) / kCorrelationM);
  const double fresh = std::sqrt(1.0 - kept * kept);
  lost_ = kept * lost_ + fresh * normal_(random_);
  side_ = kept * side_ + fresh * normal_(random_);
}

double WheelSlip::slip_ratio(double softness) const {
  const double lost = params_.slip_share + params_.slip_sd * lost_ + kLostInSoftGround * softness;
  return std::clamp(lost, 0.0, kLostMax);
}

double WheelSlip::side_slip_rad(double softness) const {
  return params_.side_slip_sd_rad * side_ * (1.0 + kSideInSoftGround * softness);
}

}  // namespace adit
