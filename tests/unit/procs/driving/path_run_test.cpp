// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "procs/driving/blended_run.hpp"
#include "tests/support/path_sketch.hpp"

namespace adit {
namespace {

PathRun only_run(const PlannedPath& path, const Vehicle& vehicle = {}) {
  auto runs = runs_of(path.points, SteeredPoint(vehicle));
  EXPECT_EQ(runs.size(), 1U);
  return runs.front();
}

TEST(PathRuns, AreCutWhereTheDirectionOfTravelChanges) {
  const auto path = PathSketch({}).go(2.0).back(1.5, 0.3).go(1.0).path();
  const auto runs = runs_of(path.points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].direction(), 1.0);
  EXPECT_EQ(runs[1].direction(), -1.0);
  EXPECT_EQ(runs[2].direction(), 1.0);
  EXPECT_NEAR(runs[0].length_m(), 2.0, 1e-9);
  EXPECT_NEAR(runs[1].length_m(), 1.5, 1e-3);  // chords of an arc
  EXPECT_NEAR(runs[1].at(0.0).x, 2.0, 1e-9);
}

TEST(PathRuns, NeedNoPointTwiceWhereTheDirectionChanges) {
  auto points = PathSketch({}).go(2.0).back(1.5).path().points;
  const auto cusp = std::find_if(points.begin(), points.end(), [](auto& p) { return p.reverse; });
  points.erase(cusp - 1);
  const auto runs = runs_of(points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_NEAR(runs[0].length_m(), 2.0, 1e-9);
  EXPECT_NEAR(runs[1].length_m(), 1.5, 1e-9);
}

TEST(PathRuns, OfOnePointHaveNoLength) {
  const std::vector<PathPoint> points(1);
  const auto runs = runs_of(points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].length_m(), 0.0);
  EXPECT_EQ(runs[0].at(0.0), Pose2{});
  EXPECT_EQ(runs[0].nearest_m({1.0, 1.0}, 0.0, 0.5), 0.0);
  EXPECT_EQ(runs[0].curvature_1_m(0.0, 1.0), 0.0);
  EXPECT_EQ(blended(runs[0], 0.5).length_m(), 0.0);
}

TEST(PathRun, KnowsItsCurvatureInBothDirections) {
  const PathRun left = only_run(PathSketch({}).go(3.0, 0.5).path());
  EXPECT_NEAR(left.curvature_1_m(0.7, 1.9), 0.5, 1e-3);  // chords of an arc
  const PathRun back = only_run(PathSketch({}).back(3.0, 0.5).path());
  EXPECT_NEAR(back.curvature_1_m(0.7, 1.9), 0.5, 1e-3);
}

TEST(PathRun, GoesOnBehindItsEndAsItBends) {
  const PathRun run = only_run(PathSketch({}).back(3.0, 0.5).path());
  const Pose2 longer = PathSketch({}).back(3.6, 0.5).path().points.back().T_odom_body;
  const Pose2 behind = run.at(run.length_m() + 0.6);
  EXPECT_NEAR(behind.x, longer.x, 1e-3);
  EXPECT_NEAR(behind.y, longer.y, 1e-3);
  EXPECT_NEAR(behind.theta, longer.theta, 1e-3);
}

TEST(PathRun, TurnsMoreThanOnceRoundWithoutAJump) {
  const PathRun run = only_run(PathSketch({}).go(30.0, 0.5).path());  // 15 rad
  for (double s_m = 0.1; s_m < 29.0; s_m += 0.1) {
    ASSERT_NEAR(run.curvature_1_m(s_m, s_m + 0.5), 0.5, 1e-3);
  }
}

TEST(PathRun, IsThatOfTheRearAxleWithAckermannSteering) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  const PathRun run = only_run(PathSketch(vehicle).go(3.0, 0.5).path(), vehicle);
  EXPECT_NEAR(run.at(0.0).x, -vehicle.wheelbase_m / 2.0, 1e-9);
  const double radius = std::sqrt(4.0 - 0.75 * 0.75);
  EXPECT_NEAR(run.curvature_1_m(1.0, 2.0), 1.0 / radius, 1e-3);
  EXPECT_NEAR(SteeredPoint(vehicle).curvature_of_origin(1.0 / radius), 0.5, 1e-12);
}

TEST(SteeredPointOfAVehicle, IsRefusedWhereNoPathIsAsTight) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  vehicle.turning_radius_m = vehicle.wheelbase_m / 2.0;
  EXPECT_THROW(SteeredPoint{vehicle}, std::invalid_argument);
}

TEST(BlendedRun, TurnsAJumpOfCurvatureIntoARamp) {
  const double jump = 0.5;
  const PathRun run = blended(only_run(PathSketch({}, {}, 0.01).go(2.0).go(2.0, jump).path()), 0.5);
  for (const double s_m : {1.8, 1.9, 2.0, 2.1, 2.2}) {
    const double ramp = jump * (s_m - 1.75) / 0.5;
    EXPECT_NEAR(run.curvature_1_m(s_m - 0.05, s_m + 0.05), ramp, 0.02);  // knots 5 cm apart
  }
  EXPECT_NEAR(run.at(1.5).y, 0.0, 1e-9);
}

TEST(BlendedRun, CutsABendByAsMuchAsItSays) {
  const PathRun run = blended(only_run(PathSketch({}, {}, 0.01).go(6.0, 0.5).path()), 0.5);
  const double radius = (run.at(3.0).translation() - Eigen::Vector2d(0.0, 2.0)).norm();
  EXPECT_NEAR(2.0 - radius, 0.5 * 0.5 * 0.5 / 24.0, 2e-4);  // that it has knots
}

TEST(BlendedRun, BeginsAndEndsWhereTheRunDoes) {
  const PathRun raw = only_run(PathSketch({}).go(1.0, 0.6).go(1.0, -0.6).path());
  const PathRun run = blended(raw, 0.5);
  for (const auto& [a, b] : {std::pair{raw.at(0.0), run.at(0.0)},
                             std::pair{raw.at(raw.length_m()), run.at(run.length_m())}}) {
    EXPECT_NEAR(between(a, b).vector().norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace adit
