// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/known_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/pose_graph/map_correction.hpp"
#include "procs/planning/goals/retrace.hpp"

namespace adit {
namespace {

constexpr double kNearM = 0.25;  // points of a path are 0.2 m apart
constexpr double kNearRad = 0.2;
constexpr double kJumpM = 0.5;  // between two poses
constexpr double kJumpRad = 0.5;
constexpr std::size_t kPointsMax = 100'000;  // 20 km

std::int64_t cell_along(double x_m) { return static_cast<std::int64_t>(std::floor(x_m / kNearM)); }

/// The footprint is symmetric: either end may be ahead.
bool is_at(const Pose2& T_odom_a, const Pose2& T_odom_b) {
  const double turned_rad = std::remainder(T_odom_a.theta - T_odom_b.theta, std::numbers::pi);
  return (T_odom_a.translation() - T_odom_b.translation()).norm() <= kNearM &&
         std::abs(turned_rad) <= kNearRad;
}

}  // namespace

void KnownClearance::add_pose(const Pose2& T_odom_body) {
  if (T_odom_body_) {
    const Pose2 step = between(*T_odom_body_, T_odom_body);
    driven_m_ += step.translation().norm();
    if (step.translation().norm() > kJumpM || std::abs(step.theta) > kJumpRad) {
      clear();
      T_map_odom_.reset();
    }
  }
  T_odom_body_ = T_odom_body;
}

void KnownClearance::clear() {
  cells_.clear();
  points_ = 0;
}

void KnownClearance::add_path(const PlannedPath& path) {
  if (path.outcome != PlanOutcome::kFound) return;
  if (points_ + path.points.size() > kPointsMax) clear();
  for (const PathPoint& point : path.points) add({point.T_odom_body, point.clearance_m, driven_m_});
}

void KnownClearance::add(const Point& point) {
  cells_[{cell_along(point.T_odom_body.x), cell_along(point.T_odom_body.y)}].push_back(point);
  ++points_;
}

void KnownClearance::set_correction(const Pose2& T_map_odom) {
  const auto before = std::exchange(T_map_odom_, T_map_odom);
  if (!before || *before == T_map_odom) return;
  const Pose2 T_after_before = between(T_map_odom, *before);
  const auto cells = std::exchange(cells_, {});
  points_ = 0;
  for (const auto& [cell, points] : cells) {
    for (Point point : points) {
      if (point.driven_m < driven_m_ - kKeepsPlaceInOdomM)
        point.T_odom_body = T_after_before * point.T_odom_body;
      add(point);
    }
  }
}

std::optional<double> KnownClearance::at(const Pose2& T_odom_body) const {
  const std::int64_t column = cell_along(T_odom_body.x);
  const std::int64_t row = cell_along(T_odom_body.y);
  std::optional<double> least_m;
  for (std::int64_t i = column - 1; i <= column + 1; ++i) {
    for (std::int64_t j = row - 1; j <= row + 1; ++j) {
      const auto cell = cells_.find({i, j});
      if (cell == cells_.end()) continue;
      for (const Point& point : cell->second) {
        if (!is_at(point.T_odom_body, T_odom_body)) continue;
        least_m = std::min(least_m.value_or(point.clearance_m), point.clearance_m);
      }
    }
  }
  return least_m;
}

void KnownClearance::apply(PlannedPath& path) const {
  for (PathPoint& point : path.points) {
    if (point.clearance_m != kRetracedClearanceM) continue;
    point.clearance_m = at(point.T_odom_body).value_or(point.clearance_m);
  }
}

}  // namespace adit
