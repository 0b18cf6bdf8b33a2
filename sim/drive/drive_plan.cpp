// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/drive_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace adit {
namespace {

constexpr double kBehind = 0.75 * std::numbers::pi;  // within 45° of straight back
constexpr double kSameM = 1e-3;                      // nearer waypoints are one

struct Leg {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double speed_m_s = 0.0;
  bool reverse = false;
};

/// From where the body is, in order, without those that lead nowhere.
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
    plan.push_back({LeggedWay(std::move(points)), std::move(speeds), reverse});
  }
  return plan;
}

}  // namespace adit
