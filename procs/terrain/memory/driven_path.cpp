// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/driven_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.1;
constexpr double kStepRad = 0.1;
constexpr double kJumpM = 0.5;    // beyond what the body can drive in the time
constexpr double kJumpRad = 0.7;  // within a second
constexpr std::size_t kPlaces = 2000;

}  // namespace

bool DrivenPath::can_follow(std::int64_t utime, const Pose2& T_odom_body) const {
  if (!last_) return true;
  const double since_s = seconds(std::max<std::int64_t>(utime - last_->utime, 0));
  const Pose2 step = between(last_->T_odom_body, T_odom_body);
  if (step.translation().norm() > kJumpM + 2.0 * speed_max_m_s_ * since_s) return false;
  return since_s > 1.0 || std::abs(step.theta) < kJumpRad;
}

bool DrivenPath::add(std::int64_t utime, const Pose2& T_odom_body) {
  const bool follows = can_follow(utime, T_odom_body);
  last_ = {utime, T_odom_body};
  if (!follows) previous_ = std::exchange(places_, {});
  if (!places_.empty()) {
    const Pose2 step = between(places_.back().T_odom_body, T_odom_body);
    const double step_length_m = step.translation().norm();
    if (step_length_m < kStepM && std::abs(step.theta) < kStepRad) return follows;
    distance_travelled_m_ += step_length_m;
  }
  places_.push_back({T_odom_body, distance_travelled_m_, utime});
  while (places_.size() > kPlaces ||
         places_.front().distance_travelled_m < distance_travelled_m_ - path_length_max_m_) {
    places_.pop_front();
  }
  return follows;
}

/// Poses of the new odom frame may have arrived before the report of it.
bool DrivenPath::reset(std::int64_t odom_epoch_utime) {
  const auto end = std::ranges::find_if(
      places_, [&](const Place& place) { return place.utime >= odom_epoch_utime; });
  if (end == places_.begin()) return false;
  previous_.assign(places_.begin(), end);
  places_.erase(places_.begin(), end);
  if (last_ && last_->utime < odom_epoch_utime) last_.reset();
  return true;
}

void DrivenPath::anchor(const Pose2& T_odom_previous) {
  for (auto place = previous_.rbegin(); place != previous_.rend(); ++place) {
    places_.push_front(
        {T_odom_previous * place->T_odom_body, place->distance_travelled_m, place->utime});
  }
  previous_.clear();
}

}  // namespace adit
