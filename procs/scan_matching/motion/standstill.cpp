// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/standstill.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

bool Standstill::refuted_by(LaserId laser, const ScanMatch& match) {
  if (contradicting_scans_ >= params_.refute_scans) return true;
  if (match.status != ScanMatch::Status::kMatched) return false;
  const Pose2& first = first_match_.try_emplace(laser, match.T_odom_body).first->second;
  const Pose2 off = between(first, match.T_odom_body);
  const bool contradicts =
      off.translation().norm() > params_.refute_m || std::abs(off.theta) > params_.refute_rad;
  contradicting_scans_ = contradicts ? contradicting_scans_ + 1 : 0;
  return contradicting_scans_ >= params_.refute_scans;
}

void Standstill::apply(LaserId laser, const MotionEstimate& expected, ScanMatch& match) {
  if (!expected.stationary) {
    T_odom_body_.reset();
    first_match_.clear();
    contradicting_scans_ = 0;
    return;
  }
  if (!T_odom_body_) T_odom_body_ = expected.T_odom_last;
  if (refuted_by(laser, match)) return;
  match.T_odom_body = *T_odom_body_;
  const double dt = std::max(1e-3, seconds(match.utime - match.reference_utime));
  const double xy = params_.sd_m_per_sqrt_s * params_.sd_m_per_sqrt_s * dt;
  const double theta = params_.sd_rad_per_sqrt_s * params_.sd_rad_per_sqrt_s * dt;
  match.covariance = Eigen::Vector3d(xy, xy, theta).asDiagonal();
}

}  // namespace adit
