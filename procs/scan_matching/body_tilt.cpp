// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/body_tilt.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]
constexpr double kGapMaxS = 0.2;   // maximum time for which a turn rate is extrapolated

/// Slope along x and y of the plane normal to `up_body` [m/m].
Eigen::Vector2d rise_per_m(const Eigen::Vector3d& up_body) {
  return up_body.head<2>() / std::max(up_body.z(), 0.1);
}

}  // namespace

void BodyTilt::add(const ImuReading& reading) {
  if (reading.utime <= utime_) return;
  const Eigen::Vector3d& force = reading.linear_acceleration;
  if (!force.allFinite() || !reading.angular_velocity.allFinite()) return;
  const double dt_s = seconds(reading.utime - utime_);
  utime_ = reading.utime;
  const bool is_gravity = std::abs(force.norm() - kGravity) <= params_.deviation_max_m_s2;
  if (!up_body_) {
    if (!is_gravity) return;
    up_body_ = force.normalized();
    ground_ = rise_per_m(*up_body_);
    return;
  }
  Eigen::Vector3d up = *up_body_;
  if (dt_s <= kGapMaxS) {
    up += dt_s * up.cross(reading.angular_velocity);
    ground_ += dt_s * reading.angular_velocity.z() * Eigen::Vector2d(ground_.y(), -ground_.x());
  }
  if (is_gravity) up += std::min(1.0, dt_s / params_.time_constant_s) * (force.normalized() - up);
  up_body_ = up.normalized();
}

void BodyTilt::drive(double distance_m) {
  if (!up_body_) return;
  const double share = 1.0 - std::exp(-distance_m / params_.ground_m);
  ground_ += share * (rise_per_m(*up_body_) - ground_);
}

bool BodyTilt::is_level_at(const Eigen::Vector2d& p_body) const {
  if (!up_body_) return true;
  return std::abs((rise_per_m(*up_body_) - ground_).dot(p_body)) <= params_.rise_max_m;
}

}  // namespace adit
