// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/local_reference.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace adit {
namespace {

constexpr double kForgetIntervalM = 1.0;  // removal visits all surfels

}  // namespace

bool LocalReference::is_steep_at(const SurfacePoint& point_body, const Pose2& T_odom_body) const {
  constexpr double kOnWallM = 0.1;
  const Eigen::Vector2d n_odom = Eigen::Rotation2Dd(T_odom_body.theta) * point_body.normal;
  const Eigen::Vector2d p_odom = T_odom_body * point_body.p;
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -low_m;
  for (const SurfelMap* const surfels : {&surfels_, &apart_}) {
    const Surfel* const wall = surfels->nearest(p_odom, n_odom, kOnWallM).surfel;
    if (wall == nullptr) continue;
    low_m = std::min(low_m, wall->z_min_m);
    high_m = std::max(high_m, wall->z_max_m);
  }
  return high_m - low_m > Surfel::kSteepM;
}

double LocalReference::contradiction_share(const ScanObservation& observation,
                                           const Pose2& T_odom_body) const {
  const auto found = keyframes_.find(observation.laser);
  if (found == keyframes_.end()) return 0.0;
  const Keyframe& keyframe = found->second;
  const std::size_t points = observation.points.size() + keyframe.observation.points.size();
  if (points == 0) return 0.0;
  const Pose2 T_key_body = between(keyframe.T_odom_body, T_odom_body);
  const double margin = params_.contradiction_margin_m;
  const int inside =
      keyframe.observation.free_space.count_inside(observation.points, T_key_body, margin) +
      observation.free_space.count_inside(keyframe.observation.points, T_key_body.inverse(),
                                          margin);
  return static_cast<double>(inside) / static_cast<double>(points);
}

void LocalReference::add_keyframe(ScanObservation observation, const Pose2& T_odom_body,
                                  double odometer_m, bool ground_apart) {
  const auto found = keyframes_.find(observation.laser);
  if (found != keyframes_.end()) {
    const Pose2 moved = between(found->second.T_odom_body, T_odom_body);
    const bool far = moved.translation().norm() >= params_.keyframe_distance_m ||
                     std::abs(moved.theta) >= params_.keyframe_angle_rad;
    if (!far) return;
  }
  if (odometer_m >= forget_at_m_) {
    surfels_.remove_before(odometer_m - params_.memory_m);
    apart_.remove_before(odometer_m - params_.memory_m);
    forget_at_m_ = odometer_m + kForgetIntervalM;
  }
  insert(std::move(observation), T_odom_body, odometer_m, ground_apart);
}

void LocalReference::reset_laser(ScanObservation observation, const Pose2& T_odom_body,
                                 double odometer_m) {
  insert(std::move(observation), T_odom_body, odometer_m);
}

void LocalReference::reset(ScanObservation observation, const Pose2& T_odom_body,
                           double odometer_m) {
  surfels_.clear();
  apart_.clear();
  keyframes_.clear();
  insert(std::move(observation), T_odom_body, odometer_m);
}

void LocalReference::insert(ScanObservation observation, const Pose2& T_odom_body,
                            double odometer_m, bool ground_apart) {
  if (ground_apart) {
    std::vector<SurfacePoint> ground;
    std::vector<SurfacePoint> walls;
    std::ranges::partition_copy(
        observation.points, std::back_inserter(ground), std::back_inserter(walls),
        [](const SurfacePoint& point) { return point.grade_group.has_value(); });
    apart_.insert(ground, T_odom_body, odometer_m);
    surfels_.insert(walls, T_odom_body, odometer_m);
  } else {
    surfels_.insert(observation.points, T_odom_body, odometer_m);
  }
  const LaserId laser = observation.laser;
  keyframes_[laser] = {std::move(observation), T_odom_body};
}

}  // namespace adit
