// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/drive_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace adit {

WaypointPath::WaypointPath(std::vector<Eigen::Vector2d> points)
    : points_(std::move(points)), starts_m_{0.0} {
  for (std::size_t i = 1; i < points_.size(); ++i) {
    starts_m_.push_back(starts_m_.back() + (points_[i] - points_[i - 1]).norm());
  }
}

Eigen::Vector2d WaypointPath::at(double s_m) const {
  const std::size_t i = leg(s_m);
  return points_[i] + (s_m - starts_m_[i]) * direction(i);
}

std::size_t WaypointPath::leg(double s_m) const {
  const auto next = std::upper_bound(starts_m_.begin() + 1, starts_m_.end() - 1, s_m);
  return static_cast<std::size_t>(next - starts_m_.begin()) - 1;
}

double WaypointPath::heading_rad(std::size_t leg) const {
  const Eigen::Vector2d ahead = direction(leg);
  return std::atan2(ahead.y(), ahead.x());
}

double WaypointPath::nearest_m(const Eigen::Vector2d& p_world, double from_m, double to_m) const {
  double nearest = from_m;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = leg(from_m); i <= leg(to_m); ++i) {
    const double low = std::max(from_m, starts_m_[i]);
    const double high = std::max(low, std::min(to_m, starts_m_[i + 1]));
    const double s = starts_m_[i] + (p_world - points_[i]).dot(direction(i));
    const double here = std::clamp(s, low, high);
    const double d = (at(here) - p_world).norm();
    if (d >= distance) continue;
    distance = d;
    nearest = here;
  }
  return nearest;
}

Eigen::Vector2d WaypointPath::direction(std::size_t leg) const {
  return (points_[leg + 1] - points_[leg]).normalized();
}

namespace {

constexpr double kBehind = 0.75 * std::numbers::pi;  // within 45° of straight back
constexpr double kSameM = 1e-3;                      // nearer waypoints are one

struct Leg {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double speed_m_s = 0.0;
  bool reverse = false;
};

/// The straight legs from the pose of the body through the waypoints, without legs shorter than
/// kSameM.
std::vector<Leg> legs_through(const std::vector<Waypoint>& waypoints, const Pose2& T_world_body,
                              const DrivePlanParams& params) {
  std::vector<Leg> legs;
  Eigen::Vector2d from = T_world_body.translation();
  double heading = T_world_body.theta;
  for (const Waypoint& waypoint : waypoints) {
    const Eigen::Vector2d step = waypoint.p_world - from;
    if (step.norm() < kSameM) continue;
    const double direction = std::atan2(step.y(), step.x());
    const bool reverse = params.reverse && std::abs(angle_diff(direction, heading)) > kBehind;
    const double speed_m_s = waypoint.speed_m_s.value_or(params.speed_m_s);
    legs.push_back({from, waypoint.p_world, std::min(speed_m_s, params.speed_max_m_s), reverse});
    heading = reverse ? direction + std::numbers::pi : direction;
    from = waypoint.p_world;
  }
  return legs;
}

}  // namespace

std::vector<DriveLegs> plan_drive(const std::vector<Waypoint>& waypoints, const Pose2& T_world_body,
                                  const DrivePlanParams& params) {
  const auto legs = legs_through(waypoints, T_world_body, params);
  std::vector<DriveLegs> plan;
  for (std::size_t i = 0; i < legs.size();) {
    std::vector<Eigen::Vector2d> points{legs[i].from};
    std::vector<double> speeds;
    const bool reverse = legs[i].reverse;
    for (; i < legs.size() && legs[i].reverse == reverse; ++i) {
      points.push_back(legs[i].to);
      speeds.push_back(legs[i].speed_m_s);
    }
    plan.push_back({WaypointPath(std::move(points)), std::move(speeds), reverse});
  }
  return plan;
}

}  // namespace adit
