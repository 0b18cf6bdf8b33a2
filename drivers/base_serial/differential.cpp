// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/differential.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kSpeedWindowUs = 100'000;

/// Right also where the counter has overflowed in between.
double ticks_between(std::int32_t from, std::int32_t to) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(to) -
                                   static_cast<std::uint32_t>(from));
}

}  // namespace

SideSpeeds side_speeds(double speed_m_s, double curvature_1_m, double track_width_m,
                       double speed_max_m_s) {
  const double half_turn = 0.5 * curvature_1_m * track_width_m;
  const double fastest = std::abs(speed_m_s) * (1.0 + std::abs(half_turn));
  const double share = fastest > speed_max_m_s ? speed_max_m_s / fastest : 1.0;
  return {share * speed_m_s * (1.0 - half_turn), share * speed_m_s * (1.0 + half_turn)};
}

DifferentialOdometry::Step DifferentialOdometry::step(const Sample& from, const Sample& to) const {
  const double left_m = ticks_between(from.left_ticks, to.left_ticks) / ticks_per_m_;
  const double right_m = ticks_between(from.right_ticks, to.right_ticks) / ticks_per_m_;
  return {0.5 * (left_m + right_m), (right_m - left_m) / track_width_m_};
}

double DifferentialOdometry::moved_m(std::int32_t left_ticks, std::int32_t right_ticks) const {
  if (samples_.empty()) return 0.0;
  const double left = std::abs(ticks_between(samples_.back().left_ticks, left_ticks));
  const double right = std::abs(ticks_between(samples_.back().right_ticks, right_ticks));
  return std::max(left, right) / ticks_per_m_;
}

void DifferentialOdometry::add(std::int64_t device_us, std::int32_t left_ticks,
                               std::int32_t right_ticks) {
  const Sample now{device_us, left_ticks, right_ticks};
  speed_m_s_ = 0.0;
  yaw_rate_rad_s_ = 0.0;
  if (!samples_.empty()) {
    const Step last = step(samples_.back(), now);
    const double theta = T_wheel_body_.theta + last.turn_rad;
    T_wheel_body_ = T_wheel_body_ * along_arc(last.length_m, last.turn_rad);
    T_wheel_body_.theta = theta;
    while (samples_.size() > 1 && device_us - samples_.front().device_us > kSpeedWindowUs) {
      samples_.pop_front();
    }
    const Step window = step(samples_.front(), now);
    const double window_s = 1e-6 * static_cast<double>(device_us - samples_.front().device_us);
    speed_m_s_ = window.length_m / window_s;
    yaw_rate_rad_s_ = window.turn_rad / window_s;
  }
  samples_.push_back(now);
}

}  // namespace adit
