// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/attitude_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]
constexpr std::int64_t kGravityTimeoutUs = 10'000'000;
constexpr double kBiasMaxRadS = 0.02;
constexpr double kGapMaxS = 0.1;  // maximum integration step

}  // namespace

void AttitudeFilter::add(const ImuReading& reading, std::int64_t at_us,
                         const Eigen::Vector3d& acceleration) {
  const double since_s = seconds(at_us - last_us_.value_or(at_us));
  const double seconds = std::clamp(since_s, 0.0, kGapMaxS);
  last_us_ = at_us;
  const Eigen::Vector3d force = reading.linear_acceleration - acceleration;
  const bool is_gravity = std::abs(force.norm() - kGravity) <= params_.deviation_max_m_s2;
  if (is_gravity) gravity_us_ = at_us;
  if (!up_body_) {
    if (is_gravity) up_body_ = force.normalized();
    return;
  }
  // In the body frame the up direction rotates by the negative angular velocity.
  Eigen::Vector3d up =
      *up_body_ - seconds * (reading.angular_velocity - bias_rad_s_).cross(*up_body_);
  const double share = seconds / (params_.settling_s + seconds);
  if (is_gravity) {
    if (params_.bias_s > 0.0) {
      const Eigen::Vector3d turn = up.cross(force.normalized());
      bias_rad_s_ += seconds / (params_.settling_s * params_.bias_s) * turn;
      bias_rad_s_ = bias_rad_s_.cwiseMax(-kBiasMaxRadS).cwiseMin(kBiasMaxRadS);
    }
    up += share * (force.normalized() - up);
  }
  if (up.allFinite() && up.norm() > 0.0) {
    up_body_ = up.normalized();
  } else {  // the angular velocity overflows
    up_body_.reset();
    bias_rad_s_.setZero();
    gravity_us_.reset();
  }
}

bool AttitudeFilter::is_known(std::int64_t now_us) const {
  return gravity_us_ && now_us - *gravity_us_ <= kGravityTimeoutUs;
}

double pitch_up_rad(const Eigen::Vector3d& up_body) {
  return std::asin(std::clamp(up_body.x(), -1.0, 1.0));
}

double roll_rad(const Eigen::Vector3d& up_body) { return std::atan2(up_body.y(), up_body.z()); }

}  // namespace adit
