// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pose_filter.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/pose2.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

double seconds_between(std::int64_t from_utime, std::int64_t to_utime) {
  return seconds(to_utime - from_utime);
}

bool is_jump(const Pose2& T_expected_measured) {
  return T_expected_measured.translation().norm() > PoseFilter::kJumpM ||
         std::abs(T_expected_measured.theta) > PoseFilter::kJumpRad;
}

}  // namespace

/// The first poses are averaged with equal weights.
double PoseFilter::gain(double seconds) const {
  return std::max(1.0 / (n_ + 1), 1.0 - std::exp(-seconds / smoothing_s_));
}

void PoseFilter::add(std::int64_t utime, const Pose2& T_odom_steered) {
  const double seconds = seconds_between(utime_, utime);
  if (n_ > 0 && seconds <= 0.0 && seconds > -kGapS) return;
  const Pose2 T_odom_expected = at(utime);
  const Pose2 T_expected_measured = between(T_odom_expected, T_odom_steered);
  if (n_ == 0 || std::abs(seconds) > kGapS || is_jump(T_expected_measured)) {
    n_ = 1;
    T_odom_steered_ = T_odom_steered;
  } else {
    const double share = gain(seconds);
    T_odom_steered_ =
        T_odom_expected * Pose2{share * T_expected_measured.x, share * T_expected_measured.y,
                                share * T_expected_measured.theta};
    ++n_;
  }
  utime_ = utime;
}

void PoseFilter::set_motion(double speed_m_s, double curvature_1_m) {
  speed_m_s_ = speed_m_s;
  curvature_1_m_ = curvature_1_m;
}

std::optional<std::int64_t> PoseFilter::utime() const {
  if (n_ == 0) return std::nullopt;
  return utime_;
}

Pose2 PoseFilter::at(std::int64_t utime) const {
  const double distance_m = speed_m_s_ * seconds_between(utime_, utime);
  return T_odom_steered_ * along_arc(distance_m, distance_m * curvature_1_m_);
}

}  // namespace adit
