// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/motion_permission.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

void LocalizationMonitor::add_match(std::int64_t utime, ScanMatch::Status status) {
  if (status == ScanMatch::Status::kMatched) lost_utime_.reset();
  if (status == ScanMatch::Status::kLost && !lost_utime_) lost_utime_ = utime;
}

std::optional<std::string> LocalizationMonitor::lost_reason(
    std::int64_t utime, const std::optional<std::int64_t>& pose_utime) const {
  const auto seconds_since = [utime](std::int64_t then) { return seconds(utime - then); };
  if (!pose_utime) return "no pose received yet";
  if (seconds_since(*pose_utime) > params_.pose_age_max_s) return "the newest pose is stale";
  if (seconds_since(*pose_utime) < -params_.pose_age_max_s) {
    return "the newest pose is from the future";
  }
  // The absolute value: after a step back of the clock the time of the loss is unknown.
  if (lost_utime_ && std::abs(seconds_since(*lost_utime_)) > params_.lost_max_s) {
    return "scan matching is lost";
  }
  return std::nullopt;
}

void MissionPermission::update(const MissionPhase& phase, std::int64_t utime) {
  phase_ = phase;
  utime_ = utime;
}

std::optional<std::string> MissionPermission::denial_reason(std::int64_t utime,
                                                            std::int32_t path_id) const {
  if (!phase_) return std::nullopt;
  if (utime - utime_ > kTimeoutUs) return "mission phase timed out";
  if (phase_->phase != Phase::kExecute) return "the mission is not executing a path";
  if (phase_->goal_id != path_id) return "the mission is executing another path";
  return std::nullopt;
}

double VehicleFeedback::speed_m_s(std::int64_t utime, double commanded_m_s) const {
  if (!is_fresh(utime)) return commanded_m_s;
  if (hold_reason(utime)) return state_->speed_m_s;
  const double since_s = std::abs(seconds(utime - state_->utime));
  const double bound = kAccelerationM_S2 * (since_s + kPredictionS);
  return state_->speed_m_s + std::clamp(commanded_m_s - state_->speed_m_s, -bound, bound);
}

std::optional<std::string> VehicleFeedback::hold_reason(std::int64_t utime) const {
  if (!is_fresh(utime)) return std::nullopt;
  if (state_->stopped) return "held by a stop order";
  if (state_->expired) return "held since drive commands timed out";
  return std::nullopt;
}

/// A state of another clock, by a step back or from the future, is not fresh.
bool VehicleFeedback::is_fresh(std::int64_t utime) const {
  return state_ && std::abs(seconds(utime - state_->utime)) <= kTimeoutS;
}

void MotionPermission::update(std::int64_t utime, const std::optional<std::int64_t>& pose_utime,
                              std::int32_t path_id) {
  denial_reason_ = localization_.lost_reason(utime, pose_utime);
  if (!denial_reason_) denial_reason_ = mission_.denial_reason(utime, path_id);
  hold_reason_ = denial_reason_ ? std::nullopt : vehicle_.hold_reason(utime);
}

}  // namespace adit
