// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/local_reference.hpp"

#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kForgetEachM = 1.0;  // forgetting goes over all surfels

}  // namespace

double LocalReference::contradiction_share(const Sighting& sighting,
                                           const Pose2& T_odom_body) const {
  const auto found = keyframes_.find(sighting.laser);
  if (found == keyframes_.end()) return 0.0;
  const Keyframe& keyframe = found->second;
  const std::size_t points = sighting.points.size() + keyframe.sighting.points.size();
  if (points == 0) return 0.0;
  const Pose2 T_key_body = between(keyframe.T_odom_body, T_odom_body);
  const double margin = params_.contradiction_margin_m;
  const int inside =
      keyframe.sighting.free_space.count_inside(sighting.points, T_key_body, margin) +
      sighting.free_space.count_inside(keyframe.sighting.points, T_key_body.inverse(), margin);
  return static_cast<double>(inside) / static_cast<double>(points);
}

void LocalReference::remember(Sighting sighting, const Pose2& T_odom_body, double odometer_m) {
  const auto found = keyframes_.find(sighting.laser);
  if (found != keyframes_.end()) {
    const Pose2 moved = between(found->second.T_odom_body, T_odom_body);
    const bool far = moved.translation().norm() >= params_.keyframe_distance_m ||
                     std::abs(moved.theta) >= params_.keyframe_angle_rad;
    if (!far) return;
  }
  if (odometer_m >= forget_at_m_) {
    surfels_.forget_before(odometer_m - params_.memory_m);
    forget_at_m_ = odometer_m + kForgetEachM;
  }
  insert(std::move(sighting), T_odom_body, odometer_m);
}

void LocalReference::begin_anew(Sighting sighting, const Pose2& T_odom_body, double odometer_m) {
  insert(std::move(sighting), T_odom_body, odometer_m);
}

void LocalReference::restart(Sighting sighting, const Pose2& T_odom_body, double odometer_m) {
  surfels_.clear();
  keyframes_.clear();
  insert(std::move(sighting), T_odom_body, odometer_m);
}

void LocalReference::insert(Sighting sighting, const Pose2& T_odom_body, double odometer_m) {
  surfels_.insert(sighting.points, T_odom_body, odometer_m);
  const LaserId laser = sighting.laser;
  keyframes_[laser] = {std::move(sighting), T_odom_body};
}

}  // namespace adit
