// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr std::int64_t kToleranceUs = 1000;

}  // namespace

Pose2 blend(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrap_angle(a.theta + share * angle_diff(b.theta, a.theta))};
}

std::optional<Pose2> interpolate(const Trajectory& trajectory, std::int64_t utime) {
  if (trajectory.empty() || utime < trajectory.front().utime - kToleranceUs ||
      utime > trajectory.back().utime + kToleranceUs) {
    return std::nullopt;
  }
  const auto after =
      std::lower_bound(trajectory.begin(), trajectory.end(), utime,
                       [](const TimedPose& p, std::int64_t t) { return p.utime < t; });
  if (after == trajectory.begin()) return after->pose;
  if (after == trajectory.end()) return trajectory.back().pose;
  const auto before = after - 1;
  const auto span = static_cast<double>(after->utime - before->utime);
  return blend(before->pose, after->pose, static_cast<double>(utime - before->utime) / span);
}

double path_length_m(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
  }
  return length;
}

double distance_travelled_m(const Trajectory& trajectory, double step_m) {
  double length = 0.0;
  const TimedPose* last = trajectory.empty() ? nullptr : &trajectory.front();
  for (const TimedPose& pose : trajectory) {
    const double distance = (pose.pose.translation() - last->pose.translation()).norm();
    if (distance < step_m) continue;
    length += distance;
    last = &pose;
  }
  return length;
}

}  // namespace adit
