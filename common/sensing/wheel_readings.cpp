// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/wheel_readings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStationaryM = 1e-3;  // below the resolution of wheel encoders over a step
constexpr double kStationaryRad = 1e-3;

Pose2 interpolate(const WheelOdometry& a, const WheelOdometry& b, std::int64_t utime) {
  const double share =
      static_cast<double>(utime - a.utime) / static_cast<double>(b.utime - a.utime);
  const Pose2 step = between(a.T_wheel_body, b.T_wheel_body);
  return a.T_wheel_body * Pose2{share * step.x, share * step.y, share * step.theta};
}

}  // namespace

std::optional<Pose2> wheel_pose_at(const WheelReadings& wheels, std::int64_t utime,
                                   double gap_max_s) {
  const auto after = std::lower_bound(wheels.begin(), wheels.end(), utime,
                                      [](const auto& w, std::int64_t t) { return w.utime < t; });
  if (after != wheels.end() && after->utime == utime) return after->T_wheel_body;
  if (after == wheels.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after != wheels.end()) return interpolate(*before, *after, utime);
  if (seconds(utime - before->utime) > gap_max_s) return std::nullopt;
  if (before == wheels.begin()) return before->T_wheel_body;
  return interpolate(*std::prev(before), *before, utime);  // extrapolates at the last speed
}

bool wheels_stationary(const WheelReadings& wheels, std::int64_t since) {
  for (auto it = wheels.rbegin(); it != wheels.rend(); ++it) {
    const Pose2 step = between(it->T_wheel_body, wheels.back().T_wheel_body);
    if (step.translation().norm() > kStationaryM || std::abs(step.theta) > kStationaryRad)
      return false;
    if (it->utime <= since) return true;
  }
  return false;
}

}  // namespace adit
