// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/wheel_steps.hpp"

#include <utility>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr std::size_t kReadingsStored = 500;
constexpr double kReadingsGapMaxS = 0.5;
constexpr double kDrivenMaxM_s = 3.0;
constexpr double kDrivenMaxM = 0.2;  // and in any time

}  // namespace

void WheelSteps::add(const WheelOdometry& reading) {
  if (!readings_.empty() && reading.utime <= readings_.back().utime) return;
  readings_.push_back(reading);
  if (readings_.size() > kReadingsStored) readings_.pop_front();
}

std::optional<Pose2> WheelSteps::step_to(std::int64_t utime) {
  const double duration_s = seconds(utime - std::exchange(utime_, utime));
  const auto before =
      std::exchange(T_wheel_body_, wheel_pose_at(readings_, utime, kReadingsGapMaxS));
  if (!before || !T_wheel_body_) return std::nullopt;
  const Pose2 step = between(*before, *T_wheel_body_);
  if (step.translation().norm() > kDrivenMaxM_s * duration_s + kDrivenMaxM) return std::nullopt;
  return step;
}

}  // namespace adit
