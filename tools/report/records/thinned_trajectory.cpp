// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/thinned_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kStepM = 0.05;
constexpr double kStepRad = 0.02;
constexpr std::int64_t kStepUs = 1'000'000;

bool is_step(const TimedPose& from, const TimedPose& to) {
  const Pose2 step = between(from.pose, to.pose);
  return step.translation().norm() >= kStepM || std::abs(step.theta) >= kStepRad ||
         to.utime - from.utime >= kStepUs;
}

}  // namespace

void ThinnedTrajectory::add(const TimedPose& pose) {
  if (!poses_.empty() && pose.utime <= poses_.back().utime) return;
  if (poses_.size() > 1) {
    between_.push_back(poses_.back());
    if (!is_step(poses_[poses_.size() - 2], pose) && is_on_line_to(pose)) {
      poses_.pop_back();
    } else {
      between_.clear();
    }
  }
  poses_.push_back(pose);
}

/// From the last but one pose.
bool ThinnedTrajectory::is_on_line_to(const TimedPose& pose) const {
  if (std::isinf(tolerance_m_)) return true;
  const TimedPose& from = poses_[poses_.size() - 2];
  const Eigen::Vector3d line = pose.position() - from.position();
  const auto duration = static_cast<double>(pose.utime - from.utime);
  return std::ranges::all_of(between_, [&](const TimedPose& left_out) {
    const double share = static_cast<double>(left_out.utime - from.utime) / duration;
    const Eigen::Vector3d off = left_out.position() - (from.position() + share * line);
    return off.cwiseAbs().maxCoeff() <= tolerance_m_;
  });
}

}  // namespace adit
