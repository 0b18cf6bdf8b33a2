// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/progress_monitor.hpp"

#include <fmt/format.h>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStateGapMaxS = 0.5;  // between vehicle states

}  // namespace

void HoldTimeout::update(std::int64_t utime, double distance_m, bool held) {
  if (std::abs(distance_m - distance_m_) >= kProgressM) since_utime_.reset();
  if (!since_utime_) {
    distance_m_ = distance_m;
    if (held) since_utime_ = utime;
  }
  const double since_s = seconds(utime - since_utime_.value_or(utime));
  exceeded_ = held && since_s > seconds_max_;
}

void UnobservedMotion::add_match(const ScanMatch& match) {
  if (match.status != ScanMatch::Status::kMatched) return;
  unobserved_ = has_unobserved_direction(match);
  if (!unobserved_) distance_m_ = 0.0;
}

void UnobservedMotion::add_drive(double distance_m) {
  if (unobserved_) distance_m_ += std::abs(distance_m);
}

void OdometryMismatch::add_state(const VehicleState& state) {
  if (state_) {
    const double dt_s = seconds(state.utime - state_->utime);
    if (dt_s <= 0.0) return;
    const double distance_m = 0.5 * (state.speed_m_s + state_->speed_m_s) * dt_s;
    if (dt_s > kStateGapMaxS || !std::isfinite(distance_m)) return reset();
    wheels_m_ += distance_m;
    distance_travelled_m_ += std::abs(distance_m);
  }
  state_ = state;
}

void OdometryMismatch::add_pose(std::int64_t utime, const Pose2& T_odom_body,
                                const Attitude& attitude) {
  if (state_ && seconds(utime - state_->utime) > kStateGapMaxS) reset();
  if (T_odom_body_ && state_) {
    const Pose2 step = between(*T_odom_body_, T_odom_body);
    const double level_m = (Pose2{0.0, 0.0, -0.5 * step.theta} * step.translation()).x();
    pose_m_ += level_m / std::cos(attitude.pitch_rad);
  }
  T_odom_body_ = T_odom_body;
}

void ProgressMonitor::add_pose(std::int64_t utime, const Pose2& T_odom_body,
                               const Attitude& attitude) {
  odometry_mismatch_.add_pose(utime, T_odom_body, attitude);
}

void ProgressMonitor::reset() {
  hold_timeout_.reset();
  unobserved_.reset();
  odometry_mismatch_.reset();
}

std::optional<std::string> ProgressMonitor::failure_reason(std::int64_t utime,
                                                           const Tracking& tracking) {
  hold_timeout_.update(utime, tracking.distance_travelled_m, tracking.hold_reason.has_value());
  const double heading_rad = std::abs(tracking.error.heading_rad);
  if (tracking.distance_m > limits_.distance_max_m) {
    return fmt::format("{:.2f} m off the path", tracking.distance_m);
  }
  if (heading_rad > limits_.heading_max_rad) {
    return fmt::format("heading {:.0f} degrees off the path", rad_to_deg(heading_rad));
  }
  if (hold_timeout_.is_exceeded()) {
    return fmt::format("{}, no progress for {:.0f} s", *tracking.hold_reason,
                       limits_.hold_timeout_s);
  }
  if (unobserved_.distance_m() > limits_.unobserved_distance_max_m) {
    return fmt::format("motion not observed by any sensor for {:.1f} m", unobserved_.distance_m());
  }
  const double mismatch_max_m =
      limits_.odometry_mismatch_max_m +
      limits_.odometry_mismatch_max_share * odometry_mismatch_.distance_travelled_m();
  if (std::abs(odometry_mismatch_.difference_m()) > mismatch_max_m) {
    return fmt::format("wheel odometry and scans differ by {:.2f} m",
                       odometry_mismatch_.difference_m());
  }
  return std::nullopt;
}

}  // namespace adit
