// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/retrace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/geometry/smooth_line.hpp"

namespace adit {
namespace {

constexpr double kLeastM = 0.5;
constexpr double kClearanceM = 0.1;  // nobody knows, so it goes slowly
constexpr int kReach = 2;            // neighbours that a place is smoothed with, to each side

double heading_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

/// From the body on, without what lies on it, up to where the track turns back.
std::vector<Eigen::Vector2d> usable(const std::vector<Eigen::Vector2d>& track,
                                    const Eigen::Vector2d& p_body) {
  constexpr double kApartM = 0.1;
  std::vector<Eigen::Vector2d> places{p_body};
  for (const Eigen::Vector2d& p : track) {
    const Eigen::Vector2d way = p - places.back();
    if (way.norm() < kApartM) continue;
    const std::size_t n = places.size();
    if (n > 1 && way.dot(places[n - 1] - places[n - 2]) < 0.0) break;
    places.push_back(p);
  }
  return places;
}

}  // namespace

PlannedPath retrace(const PlanGoal& goal, const Pose2& T_odom_body) {
  PlannedPath path;
  path.utime = goal.utime;
  path.id = goal.id;
  const auto line = smoothed(usable(goal.route_odom, T_odom_body.translation()), kReach);
  double way_m = 0.0;
  double heading = T_odom_body.theta;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d way = line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
    const double along = heading_of(way);
    const bool reverse = std::abs(angle_diff(along, heading)) > std::numbers::pi / 2.0;
    if (i > 0) {
      way_m += (line[i] - line[i - 1]).norm();
      heading = wrap_angle(reverse ? along + std::numbers::pi : along);
    }
    path.points.push_back({{line[i].x(), line[i].y(), heading}, 0.0, reverse, kClearanceM, way_m});
  }
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const double turn =
        angle_diff(path.points[i + 1].T_odom_body.theta, path.points[i].T_odom_body.theta);
    path.points[i].curvature_1_m =
        turn / (line[i + 1] - line[i]).norm() * (path.points[i].reverse ? -1.0 : 1.0);
  }
  path.reached_m = way_m;
  path.outcome = way_m >= kLeastM ? PlanOutcome::kFound : PlanOutcome::kBlocked;
  path.reason = way_m >= kLeastM ? "Back on its own track." : "There is no track to go back on.";
  if (path.outcome != PlanOutcome::kFound) path.points.clear();
  return path;
}

}  // namespace adit
