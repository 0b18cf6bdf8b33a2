// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/homeward_detour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace adit {
namespace {

constexpr double kRouteMaxM = 40.0;
constexpr double kDoneM = 1.5;      // of it left: less than a path ends before its goal
constexpr double kCutM = 0.6;       // distance of points of the route,
constexpr double kCutAlongM = 5.0;  // which cuts what the robot drove to turn

double length_back_m(const TraversedPath& path) {
  return path.back_length_m(std::numeric_limits<double>::infinity());
}

/// The farthest point within kCutM of the one at `from`, and within kCutAlongM along the path, or
/// the next one.
std::size_t next_after(const std::vector<Pose2>& path, std::size_t from) {
  std::size_t next = from + 1;
  double along_m = 0.0;
  for (std::size_t i = from + 1; i < path.size() && along_m <= kCutAlongM; ++i) {
    along_m += (path[i].translation() - path[i - 1].translation()).norm();
    if ((path[i].translation() - path[from].translation()).norm() <= kCutM) next = i;
  }
  return next;
}

}  // namespace

void HomewardDetour::note_blocked(const TraversedPath& path) {
  ++blocked_;
  const bool is_due = blocked_ >= kBlockedBefore && (blocked_ - kBlockedBefore) % 2 == 0;
  if (!is_due) return;
  const double length_m = kFirstM * std::exp2(begun_++);
  ends_at_m_ = std::max(0.0, length_back_m(path) - length_m);
  if (left_m(path) <= kDoneM) end();  // the start is no farther
}

double HomewardDetour::left_m(const TraversedPath& path) const {
  return ends_at_m_ ? std::max(0.0, length_back_m(path) - *ends_at_m_) : 0.0;
}

std::optional<std::vector<Eigen::Vector2d>> HomewardDetour::route_odom(
    const TraversedPath& path) const {
  const double length_m = std::min(left_m(path), kRouteMaxM);
  if (length_m <= kDoneM) return std::nullopt;
  const std::vector<Pose2> poses = path.back(length_m);
  std::vector<Eigen::Vector2d> route;
  for (std::size_t i = 0; i < poses.size(); i = next_after(poses, i))
    route.push_back(poses[i].translation());
  if (route.size() < 2) return std::nullopt;
  return route;
}

}  // namespace adit
