// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/motion_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

/// Two messages that are sent apart may arrive together.
constexpr double kArrivalJitterS = 1.0;

double distance_m(const StreamPose& a, const StreamPose& b) {
  const double plane_m = (a.T_frame_body.translation() - b.T_frame_body.translation()).norm();
  return std::max(plane_m, std::abs(a.z_m - b.z_m));
}

/// Whether the frame began after the last pose in the frame before it.
bool begins_after(const StreamPose& last, const StreamPose& pose) {
  return pose.frame_utime > last.utime && pose.frame_utime <= pose.utime;
}

}  // namespace

bool MotionSteps::Run::is_followed_by(const StreamPose& pose, std::int64_t arrival_utime) const {
  if (length == 0) return false;
  if (pose.frame_utime != last.frame_utime) return begins_after(last, pose);
  const double stamps_s = std::abs(seconds(pose.utime - last.utime));
  const double arrivals_s = std::abs(seconds(arrival_utime - last_arrival_utime));
  const double elapsed_s = std::min(stamps_s, arrivals_s + kArrivalJitterS);
  const double turn_rad = std::abs(angle_diff(pose.T_frame_body.theta, last.T_frame_body.theta));
  return distance_m(pose, last) <= kCorrectionM + kSpeedMaxM_s * elapsed_s &&
         turn_rad <= kCorrectionRad + kTurnMaxRad_s * elapsed_s;
}

void MotionSteps::Run::add(const StreamPose& pose, std::int64_t arrival_utime) {
  last = pose;
  last_arrival_utime = arrival_utime;
  ++length;
}

bool MotionSteps::can_be_followed(const StreamPose& pose) const {
  if (pose.frame_utime == 0 || pose.frame_utime != accepted_.last.frame_utime) return true;
  return distance_m(pose, accepted_.last) <= kFoundMaxM;
}

std::string_view MotionSteps::check(const StreamPose& pose, std::int64_t arrival_utime) {
  if (accepted_.length == 0 || accepted_.is_followed_by(pose, arrival_utime)) {
    accepted_.add(pose, arrival_utime);
    rejected_ = {};
    return {};
  }
  if (!rejected_.is_followed_by(pose, arrival_utime)) rejected_ = {};
  rejected_.add(pose, arrival_utime);
  if (rejected_.length < kLastingLength || !can_be_followed(pose)) return kTooFar;
  accepted_ = rejected_;
  rejected_ = {};
  return {};
}

}  // namespace adit
