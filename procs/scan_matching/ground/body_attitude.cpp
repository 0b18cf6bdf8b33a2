// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/ground/body_attitude.hpp"

#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kGapMaxS = 0.2;  // maximum time for which a turn rate is extrapolated
// The speed is measured over intervals of this length: the noise of single poses would exceed it.
constexpr double kSpeedS = 0.3;

/// Of two measurements, the one nearer to zero; zero if their signs differ.
double lesser(double a, double b) {
  if (a * b <= 0.0) return 0.0;
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

void RecentMotion::add(std::int64_t utime, const Pose2& T_frame_body) {
  if (!poses_.empty() && utime < poses_.back().utime) return;
  poses_.push_back({utime, T_frame_body});
  while (poses_.size() > 2 && seconds(utime - poses_[1].utime) > 2.0 * kSpeedS) poses_.pop_front();
  if (seconds(utime - poses_.front().utime) > 4.0 * kSpeedS) poses_.clear();  // a gap
}

std::optional<RecentMotion::Motion> RecentMotion::at(std::int64_t utime) const {
  if (poses_.size() < 3) return std::nullopt;
  const TimedPose& last = poses_.back();
  if (seconds(utime - last.utime) > 2.0 * kSpeedS) return std::nullopt;
  const TimedPose* middle = nullptr;
  for (const TimedPose& pose : poses_) {
    if (seconds(last.utime - pose.utime) >= kSpeedS) middle = &pose;
  }
  const TimedPose& first = poses_.front();
  if (middle == nullptr || middle == &first) return std::nullopt;
  const double before_s = seconds(middle->utime - first.utime);
  const double after_s = seconds(last.utime - middle->utime);
  const double before = between(first.T_frame_body, middle->T_frame_body).x / before_s;
  const double after = between(middle->T_frame_body, last.T_frame_body).x / after_s;
  return Motion{after, 2.0 * (after - before) / (before_s + after_s)};
}

void BodyAttitude::add(const ImuReading& reading) {
  if (reading.utime <= utime_) return;
  const bool finite =
      reading.linear_acceleration.allFinite() && reading.angular_velocity.allFinite();
  if (!finite) return;
  const double dt_s = seconds(reading.utime - utime_);
  utime_ = reading.utime;
  filter_.add(reading, reading.utime, acceleration(reading));
  const auto attitude = this->attitude();
  if (slopes_ && attitude && dt_s <= kGapMaxS) {
    const double turn_rad = dt_s * heading_rate_rad_s(*attitude, reading.angular_velocity);
    for (Eigen::Vector2d* slope : {&slopes_->ground, &slopes_->ramp}) {
      *slope += turn_rad * Eigen::Vector2d(slope->y(), -slope->x());
    }
  }
  if (!slopes_ && attitude) {
    const Eigen::Vector2d slope = ground_slope(*attitude);
    slopes_ = {slope, slope};
  }
}

/// Of the body, in its frame: the change of the speed along x over the last two intervals, and that
/// of a turn. The first lags by half a second at most, which the filter does not notice: what
/// matters is the sum.
Eigen::Vector3d BodyAttitude::acceleration(const ImuReading& reading) const {
  const auto matched = matched_.at(reading.utime);
  if (!matched) return Eigen::Vector3d::Zero();
  const auto wheels = wheels_.at(reading.utime).value_or(*matched);
  const double along = lesser(matched->acceleration_m_s2, wheels.acceleration_m_s2);
  const double across = lesser(matched->speed_m_s, wheels.speed_m_s) * reading.angular_velocity.z();
  const bool possible = std::abs(along) <= params_.acceleration_max_m_s2;
  return {possible ? along : 0.0, across, 0.0};
}

void BodyAttitude::drive(double distance_m) {
  const auto attitude = this->attitude();
  if (!attitude || !slopes_) return;
  const Eigen::Vector2d slope = ground_slope(*attitude);
  slopes_->ground += (1.0 - std::exp(-distance_m / params_.ground_m)) * (slope - slopes_->ground);
  slopes_->ramp += (1.0 - std::exp(-distance_m / params_.ramp_m)) * (slope - slopes_->ramp);
}

std::optional<Attitude> BodyAttitude::attitude() const {
  if (!filter_.up_body() || !filter_.is_known(utime_)) return std::nullopt;
  return Attitude::from_up(*filter_.up_body());
}

bool BodyAttitude::is_level_at(const SurfacePoint& point, double laser_m) const {
  if (!slopes_) return true;
  const double above_m = point.z_m - laser_m;
  return std::abs(above_m - slopes_->ground.dot(point.p)) <= params_.rise_max_m ||
         std::abs(above_m - slopes_->ramp.dot(point.p)) <= params_.rise_max_m;
}

}  // namespace adit
