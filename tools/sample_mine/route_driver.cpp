// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/route_driver.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// The polyline of the waypoints, measured along its length.
class Route {
 public:
  explicit Route(const std::vector<Eigen::Vector2d>& waypoints) : waypoints_(waypoints) {
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      starts_.push_back(starts_.back() + (waypoints[i] - waypoints[i - 1]).norm());
    }
  }

  [[nodiscard]] double length() const { return starts_.back(); }

  [[nodiscard]] Eigen::Vector2d at(double distance) const {
    const double s = std::clamp(distance, 0.0, length());
    const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, s);
    const auto i = static_cast<std::size_t>(after - starts_.begin());
    const double share = (s - starts_[i - 1]) / (starts_[i] - starts_[i - 1]);
    return waypoints_[i - 1] + share * (waypoints_[i] - waypoints_[i - 1]);
  }

 private:
  const std::vector<Eigen::Vector2d>& waypoints_;
  std::vector<double> starts_ = {0.0};
};

/// Motion at constant speed and yaw rate, in the frame at its start.
Pose2 arc(double speed, double yaw_rate, double seconds) {
  const double turn = yaw_rate * seconds;
  const double chord =
      speed * seconds * (std::abs(turn) < 1e-9 ? 1.0 : std::sin(turn / 2) / (turn / 2));
  return {chord * std::cos(turn / 2), chord * std::sin(turn / 2), turn};
}

/// The yaw rate of the circle through the target (Coulter 1992).
double pursue(const Pose2& T_world_body, const Eigen::Vector2d& p_world_target, double speed) {
  const Eigen::Vector2d p_body_target = T_world_body.inverse() * p_world_target;
  return speed * 2.0 * p_body_target.y() / std::max(p_body_target.squaredNorm(), 1e-6);
}

}  // namespace

Trajectory drive_route(const std::vector<Eigen::Vector2d>& waypoints, const DriveModel& model,
                       std::int64_t start_utime) {
  if (waypoints.size() < 2) return {};
  const Route route(waypoints);
  const Eigen::Vector2d heading = waypoints[1] - waypoints[0];
  Pose2 pose{waypoints[0].x(), waypoints[0].y(), std::atan2(heading.y(), heading.x())};
  const auto period_us = std::llround(model.period_s * 1e6);
  Trajectory trajectory;
  // The point of the route abreast of the vehicle moves on until it is less than a look-ahead away.
  double abreast = 0.0;
  for (std::int64_t utime = start_utime;; utime += period_us) {
    trajectory.push_back({utime, pose});
    while (abreast < route.length() &&
           (route.at(abreast) - pose.translation()).norm() < model.lookahead_m) {
      abreast += 0.02;
    }
    const Eigen::Vector2d target = route.at(abreast);
    const double left = (target - pose.translation()).norm();
    if (abreast >= route.length() && left < model.speed_m_s * model.period_s) return trajectory;
    const double yaw_rate = std::clamp(pursue(pose, target, model.speed_m_s),
                                       -model.yaw_rate_max_rad_s, model.yaw_rate_max_rad_s);
    pose = pose * arc(model.speed_m_s, yaw_rate, model.period_s);
  }
}

}  // namespace adit
