// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/wheel_slip.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kCorrelationM = 1.0;
constexpr double kLostMax = 0.9;
constexpr double kLostInSoftGround =
    0.4;  // in addition to that on firm ground, at the maximum sinkage
constexpr double kSideInSoftGround =
    3.0;  // additional factor relative to firm ground, at the maximum sinkage

}  // namespace

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
