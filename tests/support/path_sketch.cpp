// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/path_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/vehicle/steering.hpp"

namespace adit {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

}  // namespace

PathSketch::PathSketch(const Vehicle& vehicle, const Pose2& T_odom_start, double spacing_m)
    : vehicle_(vehicle), spacing_m_(spacing_m), T_odom_body_(T_odom_start) {}

PathSketch& PathSketch::go(double length_m, double curvature_1_m) {
  return add(length_m, curvature_1_m, false);
}

PathSketch& PathSketch::back(double length_m, double curvature_1_m) {
  return add(length_m, curvature_1_m, true);
}

PathSketch& PathSketch::add(double length_m, double curvature_1_m, bool reverse) {
  const Steering steering(vehicle_);
  const int pieces = std::max(1, static_cast<int>(std::lround(length_m / spacing_m_)));
  const double way_m = (reverse ? -1.0 : 1.0) * length_m / pieces;
  const Pose2 T_body_next = steering.motion(way_m, way_m * steering.turn_rad_per_m(curvature_1_m));
  constexpr double kClear = std::numeric_limits<double>::infinity();
  if (!points_.empty() && points_.back().reverse != reverse) {
    points_.push_back({T_odom_body_, 0.0, !reverse, kClear, 0.0});
  }
  for (int i = 0; i < pieces; ++i) {
    points_.push_back({T_odom_body_, curvature_1_m, reverse, kClear, 0.0});
    T_odom_body_ = T_odom_body_ * T_body_next;
  }
  return *this;
}

PlannedPath PathSketch::path() const {
  PlannedPath path;
  path.id = 1;
  path.outcome = PlanOutcome::kFound;
  path.points = points_;
  if (!points_.empty()) {
    path.points.push_back(points_.back());
    path.points.back().T_odom_body = T_odom_body_;
  }
  return path;
}

std::vector<PathShape> path_shapes(const Vehicle& vehicle, double radius_m,
                                   const Pose2& T_odom_start) {
  const auto sketch = [&] { return PathSketch(vehicle, T_odom_start); };
  const double tight = 1.0 / radius_m;
  const double quarter_m = kQuarter * radius_m;
  PathSketch slalom = sketch();
  slalom.go(1.0).go(0.5 * quarter_m, tight);
  for (int i = 0; i < 3; ++i) slalom.go(quarter_m, -tight).go(quarter_m, tight);
  slalom.go(0.5 * quarter_m, -tight).go(1.0);
  return {{"straight", sketch().go(12.0).path()},
          {"gentle S", sketch().go(1.5).go(4.0, 0.25).go(4.0, -0.25).go(1.5).path()},
          {"circle", sketch().go(1.0).go(4.0 * quarter_m, tight).go(1.0).path()},
          {"slalom", slalom.path()},
          {"three-point turn", sketch()
                                   .go(1.0)
                                   .go(quarter_m, tight)
                                   .back(quarter_m, -tight)
                                   .go(0.5 * quarter_m, tight)
                                   .go(1.0)
                                   .path()}};
}

PlannedPath driven_in_reverse(PlannedPath path) {
  const Pose2 T_odom_start = path.points.front().T_odom_body;
  const Pose2 T_odom_end = path.points.back().T_odom_body;
  std::vector<PathPoint> points(path.points.rbegin(), path.points.rend());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].T_odom_body = T_odom_start * between(T_odom_end, points[i].T_odom_body);
    // What a point says of the stretch to the next, was said by the next one.
    const PathPoint& says =
        path.points[path.points.size() - (i + 1 < points.size() ? i + 2 : i + 1)];
    points[i].reverse = !says.reverse;
    points[i].curvature_1_m = says.curvature_1_m;
  }
  path.points = points;
  return path;
}

}  // namespace adit
