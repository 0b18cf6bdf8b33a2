// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/path_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

PathRun only_run(const PlannedPath& path, const Vehicle& vehicle = {}) {
  auto runs = split_into_runs(path.points, SteeredPoint(vehicle));
  EXPECT_EQ(runs.size(), 1U);
  return runs.front();
}

TEST(SplitIntoRuns, SplitsWhereTheDirectionOfTravelChanges) {
  const auto path = TestPathBuilder({}).forward(2.0).back(1.5, 0.3).forward(1.0).path();
  const auto runs = split_into_runs(path.points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].direction(), 1.0);
  EXPECT_EQ(runs[1].direction(), -1.0);
  EXPECT_EQ(runs[2].direction(), 1.0);
  EXPECT_NEAR(runs[0].length_m(), 2.0, 1e-9);
  EXPECT_NEAR(runs[1].length_m(), 1.5, 1e-3);  // chords of an arc
  EXPECT_NEAR(runs[1].at(0.0).x, 2.0, 1e-9);
}

TEST(SplitIntoRuns, NeedsNoDuplicatePointAtAChangeOfDirection) {
  auto points = TestPathBuilder({}).forward(2.0).back(1.5).path().points;
  const auto cusp = std::find_if(points.begin(), points.end(), [](auto& p) { return p.reverse; });
  points.erase(cusp - 1);
  const auto runs = split_into_runs(points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_NEAR(runs[0].length_m(), 2.0, 1e-9);
  EXPECT_NEAR(runs[1].length_m(), 1.5, 1e-9);
}

TEST(SplitIntoRuns, YieldsARunOfZeroLengthFromOnePoint) {
  const std::vector<PathPoint> points(1);
  const auto runs = split_into_runs(points, SteeredPoint({}));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].length_m(), 0.0);
  EXPECT_EQ(runs[0].at(0.0), Pose2{});
  EXPECT_EQ(runs[0].nearest_s_m({1.0, 1.0}, 0.0, 0.5), 0.0);
  EXPECT_EQ(runs[0].curvature_1_m(0.0, 1.0), 0.0);
  EXPECT_EQ(blended(runs[0], 0.5, 0.5, 0.15).length_m(), 0.0);
}

TEST(PathRun, HasTheCurvatureOfThePathInBothDirections) {
  const PathRun left = only_run(TestPathBuilder({}).forward(3.0, 0.5).path());
  EXPECT_NEAR(left.curvature_1_m(0.7, 1.9), 0.5, 1e-3);  // chords of an arc
  const PathRun back = only_run(TestPathBuilder({}).back(3.0, 0.5).path());
  EXPECT_NEAR(back.curvature_1_m(0.7, 1.9), 0.5, 1e-3);
}

TEST(PathRun, ContinuesBeyondItsEndWithItsLastCurvature) {
  const PathRun run = only_run(TestPathBuilder({}).back(3.0, 0.5).path());
  const Pose2 longer = TestPathBuilder({}).back(3.6, 0.5).path().points.back().T_odom_body;
  const Pose2 beyond = run.at(run.length_m() + 0.6);
  EXPECT_NEAR(beyond.x, longer.x, 1e-3);
  EXPECT_NEAR(beyond.y, longer.y, 1e-3);
  EXPECT_NEAR(beyond.theta, longer.theta, 1e-3);
}

TEST(PathRun, HasNoJumpOfTheHeadingAfterAFullTurn) {
  const PathRun run = only_run(TestPathBuilder({}).forward(30.0, 0.5).path());  // 15 rad
  for (double s_m = 0.1; s_m < 29.0; s_m += 0.1) {
    ASSERT_NEAR(run.curvature_1_m(s_m, s_m + 0.5), 0.5, 1e-3);
  }
}

TEST(PathRun, IsThePathOfTheRearAxleWithAckermannSteering) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  const PathRun run = only_run(TestPathBuilder(vehicle).forward(3.0, 0.5).path(), vehicle);
  EXPECT_NEAR(run.at(0.0).x, -vehicle.wheelbase_m / 2.0, 1e-9);
  const double radius = std::sqrt(4.0 - 0.75 * 0.75);
  EXPECT_NEAR(run.curvature_1_m(1.0, 2.0), 1.0 / radius, 1e-3);
  EXPECT_NEAR(SteeredPoint(vehicle).curvature_of_origin(1.0 / radius), 0.5, 1e-12);
}

TEST(SteeredPoint, RejectsATurningRadiusOfHalfTheWheelbase) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  vehicle.turning_radius_m = vehicle.wheelbase_m / 2.0;
  EXPECT_THROW(SteeredPoint{vehicle}, std::invalid_argument);
}

TEST(BlendedRun, HasARampInsteadOfAJumpOfTheCurvature) {
  const double jump = 0.5;
  const PathRun run =
      blended(only_run(TestPathBuilder({}, {}, 0.01).forward(2.0).forward(2.0, jump).path()), 0.5,
              0.5, 0.15);
  for (const double s_m : {1.8, 1.9, 2.0, 2.1, 2.2}) {
    const double ramp = jump * (s_m - 1.75) / 0.5;
    EXPECT_NEAR(run.curvature_1_m(s_m - 0.05, s_m + 0.05), ramp, 0.02);  // knots 5 cm apart
  }
  EXPECT_NEAR(run.at(1.5).y, 0.0, 1e-9);
}

TEST(BlendedRun, CutsABendByTheDocumentedAmount) {
  const PathRun run =
      blended(only_run(TestPathBuilder({}, {}, 0.01).forward(6.0, 0.5).path()), 0.5, 0.5, 0.15);
  const double radius = (run.at(3.0).translation() - Eigen::Vector2d(0.0, 2.0)).norm();
  EXPECT_NEAR(2.0 - radius, 0.5 * 0.5 * 0.5 / 24.0, 2e-4);  // spacing of the knots
}

TEST(BlendedRun, IsWiderWhereWallsAreFar) {
  PlannedPath path = TestPathBuilder({}, {}, 0.01).forward(8.0, 0.5).path();
  for (std::size_t i = 0; i < path.points.size(); ++i)
    path.points[i].clearance_m = i < path.points.size() / 2 ? 0.15 : 0.2;
  const PathRun run = blended(only_run(path), 0.5, 1.0, 0.15);
  const auto cut_m = [&](double s_m) {
    return 2.0 - (run.at(s_m).translation() - Eigen::Vector2d(0.0, 2.0)).norm();
  };
  EXPECT_NEAR(cut_m(3.0), 0.5 * 0.5 * 0.5 / 24.0, 2e-4);  // spacing of the knots
  EXPECT_NEAR(cut_m(6.0), 0.5 * 1.0 * 1.0 / 24.0, 5e-4);  // 17 samples of the mean
  for (double s_m = 2.0; s_m < 7.0; s_m += 0.05)          // the cut changes by 1.6 cm over a metre
    EXPECT_NEAR(run.curvature_1_m(s_m - 0.05, s_m + 0.05), 0.5, 0.06) << s_m;
}

TEST(BlendedRun, KeepsTheEndsOfTheRun) {
  const PathRun raw = only_run(TestPathBuilder({}).forward(1.0, 0.6).forward(1.0, -0.6).path());
  const PathRun run = blended(raw, 0.5, 1.0, 0.15);
  for (const auto& [a, b] : {std::pair{raw.at(0.0), run.at(0.0)},
                             std::pair{raw.at(raw.length_m()), run.at(run.length_m())}}) {
    EXPECT_NEAR(between(a, b).vector().norm(), 0.0, 1e-9);
  }
}

PathProgress along(const PlannedPath& path) {
  return PathProgress(split_into_runs(path.points, SteeredPoint({})));
}

TEST(PathProgress, DoesNotJumpWhereThePathCrossesItself) {
  const double circle_m = 2.0 * std::numbers::pi * 2.0;
  const auto eight = TestPathBuilder({}).forward(circle_m, 0.5).forward(circle_m, -0.5).path();
  const PathRun run = split_into_runs(eight.points, SteeredPoint({})).front();
  PathProgress progress = along(eight);
  for (double s_m = 0.0; s_m < run.length_m(); s_m += 0.02) {
    const double lateral_m = 0.1 * std::sin(s_m);
    progress.advance(run.at(s_m) * Pose2{0.0, lateral_m, 0.0});
    ASSERT_NEAR(progress.s_m(), s_m, 0.02);  // corners between chords, 10 cm beside
    ASSERT_NEAR(progress.error(run.at(s_m) * Pose2{0.0, lateral_m, 0.0}).lateral_m, lateral_m,
                0.002);
  }
}

TEST(PathProgress, NeverDecreases) {
  PathProgress progress = along(TestPathBuilder({}).forward(5.0).path());
  progress.advance({0.4, 0.0, 0.0});
  progress.advance({0.8, 0.0, 0.0});
  progress.advance({0.5, 0.0, 0.0});
  EXPECT_NEAR(progress.s_m(), 0.8, 1e-9);
  EXPECT_NEAR(progress.remaining_m(), 4.2, 1e-9);
}

TEST(PathProgress, CompletesRunsInOrderAndSumsUpTheirLength) {
  PathProgress progress = along(TestPathBuilder({}).forward(1.0).back(2.0).path());
  for (const double x : {0.4, 0.8, 1.0}) progress.advance({x, 0.0, 0.0});
  EXPECT_NEAR(progress.run_remaining_m(), 0.0, 1e-9);
  EXPECT_NEAR(progress.remaining_m(), 2.0, 1e-9);
  ASSERT_TRUE(progress.begin_next_run());
  progress.advance({0.7, 0.1, 0.2});
  EXPECT_NEAR(progress.distance_travelled_m(), 1.3, 1e-9);
  EXPECT_NEAR(progress.error({0.7, 0.1, 0.2}).lateral_m, 0.1, 1e-9);
  EXPECT_NEAR(progress.error({0.7, 0.1, 0.2}).heading_rad, 0.2, 1e-9);
  EXPECT_FALSE(progress.begin_next_run());
}

}  // namespace
}  // namespace adit
