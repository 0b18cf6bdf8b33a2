// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/late_poses.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kPeriodUs = 26'667;

}  // namespace

LatePoses::LatePoses(const PoseNoise& noise, std::uint64_t seed) : noise_(noise), random_(seed) {
  for (double& slow : slow_) slow = normal_(random_);
}

void LatePoses::see(std::int64_t utime, const Pose2& T_odom_body) {
  if (utime < next_utime_) return;
  next_utime_ = std::max(next_utime_, utime - kPeriodUs) + kPeriodUs;
  const double kept = std::exp(-1e-6 * static_cast<double>(kPeriodUs) / noise_.slow_s);
  for (double& slow : slow_) slow = kept * slow + std::sqrt(1.0 - kept * kept) * normal_(random_);
  const auto with = [&](double value, std::size_t i, double white, double slow) {
    return value + white * normal_(random_) + slow * slow_[i];
  };
  const double x = with(T_odom_body.x, 0, noise_.white_m, noise_.slow_m);
  const double y = with(T_odom_body.y, 1, noise_.white_m, noise_.slow_m);
  const double theta = with(T_odom_body.theta, 2, noise_.white_rad, noise_.slow_rad);
  waiting_.push_back({utime, {x, y, theta}});
}

void LatePoses::deliver(
    std::int64_t utime,
    const std::function<void(std::int64_t utime, const Pose2& T_odom_body)>& take) {
  while (!waiting_.empty() && waiting_.front().utime + noise_.delay_us <= utime) {
    take(waiting_.front().utime, waiting_.front().T_odom_body);
    waiting_.pop_front();
  }
}

}  // namespace adit
