// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/drives/test_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "procs/planning/planning.hpp"
#include "sim/vehicle/kinematics.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

}  // namespace

TestPathBuilder::TestPathBuilder(const Vehicle& vehicle, const Pose2& T_odom_start,
                                 double spacing_m)
    : vehicle_(vehicle), spacing_m_(spacing_m), T_odom_body_(T_odom_start) {}

TestPathBuilder& TestPathBuilder::forward(double length_m, double curvature_1_m) {
  return add(length_m, curvature_1_m, false);
}

TestPathBuilder& TestPathBuilder::back(double length_m, double curvature_1_m) {
  return add(length_m, curvature_1_m, true);
}

TestPathBuilder& TestPathBuilder::add(double length_m, double curvature_1_m, bool reverse) {
  const Steering steering(vehicle_);
  const int steps = std::max(1, static_cast<int>(std::lround(length_m / spacing_m_)));
  const double step_m = (reverse ? -1.0 : 1.0) * length_m / steps;
  const Pose2 T_body_next =
      steering.motion(step_m, step_m * steering.turn_rad_per_m(curvature_1_m));
  constexpr double kClear = std::numeric_limits<double>::infinity();
  if (!points_.empty() && points_.back().reverse != reverse) {
    points_.push_back({T_odom_body_, 0.0, !reverse, kClear, 0.0});
  }
  for (int i = 0; i < steps; ++i) {
    points_.push_back({T_odom_body_, curvature_1_m, reverse, kClear, 0.0});
    T_odom_body_ = T_odom_body_ * T_body_next;
  }
  return *this;
}

PlannedPath TestPathBuilder::path() const {
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
  const auto builder = [&] { return TestPathBuilder(vehicle, T_odom_start); };
  const double tight = 1.0 / radius_m;
  const double quarter_m = kQuarter * radius_m;
  TestPathBuilder slalom = builder();
  slalom.forward(1.0).forward(0.5 * quarter_m, tight);
  for (int i = 0; i < 3; ++i) slalom.forward(quarter_m, -tight).forward(quarter_m, tight);
  slalom.forward(0.5 * quarter_m, -tight).forward(1.0);
  return {{"straight", builder().forward(12.0).path()},
          {"gentle S",
           builder().forward(1.5).forward(4.0, 0.25).forward(4.0, -0.25).forward(1.5).path()},
          {"circle", builder().forward(1.0).forward(4.0 * quarter_m, tight).forward(1.0).path()},
          {"slalom", slalom.path()},
          {"three-point turn", builder()
                                   .forward(1.0)
                                   .forward(quarter_m, tight)
                                   .back(quarter_m, -tight)
                                   .forward(0.5 * quarter_m, tight)
                                   .forward(1.0)
                                   .path()}};
}

PlannedPath driven_in_reverse(PlannedPath path) {
  const Pose2 T_odom_start = path.points.front().T_odom_body;
  const Pose2 T_odom_end = path.points.back().T_odom_body;
  std::vector<PathPoint> points(path.points.rbegin(), path.points.rend());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].T_odom_body = T_odom_start * between(T_odom_end, points[i].T_odom_body);
    // Direction and curvature of a segment are stored in its first point.
    const PathPoint& source =
        path.points[path.points.size() - (i + 1 < points.size() ? i + 2 : i + 1)];
    points[i].reverse = !source.reverse;
    points[i].curvature_1_m = source.curvature_1_m;
  }
  path.points = points;
  return path;
}

namespace {

constexpr double kHalfCellM = 0.05;

}  // namespace

PlannedPath random_corridor_path(std::uint32_t seed, const Vehicle& vehicle) {
  PlanningParams params;
  params.vehicle = vehicle;
  const double half_heading = std::numbers::pi / params.c_space.headings;
  std::mt19937 engine(seed);
  const auto draw = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(engine);
  };
  const Pose2 T_odom_body{draw(kHalfCellM), draw(kHalfCellM), draw(half_heading)};
  Planning planning(params);
  PlannedPath path = planning.plan(terrain_of(random_corridor(seed)), PlanGoal{}, T_odom_body);
  for (PathPoint& point : path.points) point.T_odom_body = between(T_odom_body, point.T_odom_body);
  return path;
}

}  // namespace adit
