// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/return_home.hpp"

namespace adit {
namespace {

constexpr double kSamePointM = 0.01;

/// Empty if the route of the report ends elsewhere. Frame odom.
std::optional<Eigen::Vector2d> home_at_end_of(const ExplorationReport& report) {
  if (report.decision.kind != ExplorationDecision::Kind::kHome || report.route_odom.empty()) {
    return std::nullopt;
  }
  const Eigen::Vector2d p_odom_goal = report.T_odom_goal.translation();
  if ((report.route_odom.back() - p_odom_goal).norm() > kSamePointM) return std::nullopt;
  return p_odom_goal;
}

}  // namespace

void HomeArrival::set_route(const ExplorationReport& report) {
  p_odom_home_ = home_at_end_of(report);
  if (report.decision.kind != ExplorationDecision::Kind::kHome) tries_ = 0;
}

bool HomeArrival::is_near(const std::optional<Pose2>& T_odom_body) const {
  return p_odom_home_ && T_odom_body && distance_m(*T_odom_body) <= tolerance_m_;
}

double HomeArrival::distance_m(const Pose2& T_odom_body) const {
  return (T_odom_body.translation() - *p_odom_home_).norm();
}

}  // namespace adit
