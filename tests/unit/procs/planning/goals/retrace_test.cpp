// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/retrace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kRadiusM = 4.0;
constexpr double kTurningRadiusM = 1.6;

PlanGoal retrace_goal(std::vector<Pose2> traversed) {
  PlanGoal goal;
  goal.utime = 7;
  goal.id = 3;
  goal.kind = PlanGoal::Kind::kRetrace;
  goal.traversed_path_odom = std::move(traversed);
  return goal;
}

/// The traversed path of a body that drove along a circle to the left, from the body backwards.
std::vector<Pose2> circle(double distance_m) {
  std::vector<Pose2> traversed;
  for (double s = 0.0; s <= distance_m; s += 0.2) {
    const double angle = s / kRadiusM;
    traversed.push_back({-kRadiusM * std::sin(angle), kRadiusM * (1.0 - std::cos(angle)), -angle});
  }
  return traversed;
}

/// Poses along the x axis from one point to another, with a heading.
std::vector<Pose2> line(double from_m, double to_m, double heading = 0.0) {
  std::vector<Pose2> traversed;
  const int steps = static_cast<int>(std::lround(std::abs(to_m - from_m) / 0.2));
  for (int i = 0; i <= steps; ++i) {
    traversed.push_back({from_m + (to_m - from_m) * i / steps, 0.0, heading});
  }
  return traversed;
}

TEST(Retrace, DrivesStraightBackInReverse) {
  const PlannedPath path = retrace(retrace_goal(line(0.0, -3.0)), {0, 0, 0}, kTurningRadiusM);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_EQ(path.id, 3);
  EXPECT_NEAR(path.reached_m, 3.0, 1e-9);
  for (const PathPoint& point : path.points) {
    EXPECT_TRUE(point.reverse);
    EXPECT_NEAR(point.T_odom_body.y, 0.0, 1e-9);
    EXPECT_NEAR(point.T_odom_body.theta, 0.0, 1e-9);
    EXPECT_NEAR(point.curvature_1_m, 0.0, 1e-9);
  }
  EXPECT_NEAR(path.points.back().T_odom_body.x, -3.0, 1e-9);
}

TEST(Retrace, DrivesForwardsWhereTheRobotCameInReverse) {
  const PlannedPath path = retrace(retrace_goal(line(0.0, 2.0)), {0, 0, 0.05}, kTurningRadiusM);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  for (const PathPoint& point : path.points) EXPECT_FALSE(point.reverse);
}

TEST(Retrace, FollowsABend) {
  const auto traversed = circle(5.0);
  const PlannedPath path = retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  ASSERT_EQ(path.points.size(), traversed.size());
  for (std::size_t i = 0; i < traversed.size(); ++i) {
    EXPECT_EQ(path.points[i].T_odom_body, traversed[i]);
    EXPECT_TRUE(path.points[i].reverse);
    if (i + 1 == traversed.size()) continue;
    EXPECT_NEAR(path.points[i].curvature_1_m, 1.0 / kRadiusM, 1e-3);  // of the chord: 0.04 %
  }
}

/// The robot came with a change of direction, as in a three-point turn.
TEST(Retrace, RepeatsAChangeOfDirection) {
  auto traversed = line(0.0, -2.0);
  for (const Pose2& pose : line(-1.8, 1.0)) traversed.push_back(pose);
  const PlannedPath path = retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 5.0, 1e-9);
  EXPECT_NEAR(path.points.back().T_odom_body.x, 1.0, 1e-9);
  for (std::size_t i = 0; i < path.points.size(); ++i) EXPECT_EQ(path.points[i].reverse, i < 10);
}

TEST(Retrace, IsNoLongerThanTheGoalAllows) {
  PlanGoal goal = retrace_goal(line(0.0, -8.0));
  goal.distance_m = 3.0;
  EXPECT_NEAR(retrace(goal, {0, 0, 0}, kTurningRadiusM).reached_m, 3.0, 1e-9);
}

/// A traversed path of which only parts are near is followed to the first gap.
TEST(Retrace, EndsAtAGap) {
  auto traversed = line(0.0, -2.0);
  for (const Pose2& pose : line(-4.0, -6.0)) traversed.push_back(pose);
  EXPECT_NEAR(retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM).reached_m, 2.0, 1e-9);
}

/// Ground that was driven with the other end ahead: the robot would have to turn on the spot.
TEST(Retrace, IsBlockedWhereTheTraversedPathFacesTheOtherEnd) {
  const double pi = std::numbers::pi;
  for (const double heading : {pi, 0.9 * pi, -0.6 * pi}) {
    const PlannedPath path = retrace(retrace_goal(line(-0.3, -4.0, heading)), {0, 0, 0}, 0.5);
    EXPECT_EQ(path.outcome, PlanOutcome::kBlocked) << heading;
  }
}

/// Nor does a vehicle with wheels move sideways.
TEST(Retrace, IsBlockedByGroundBesideTheRobot) {
  auto traversed = line(-0.2, -4.0);
  for (Pose2& pose : traversed) pose.y = 0.4;
  EXPECT_EQ(retrace(retrace_goal(traversed), {0, 0, 0}, 0.5).outcome, PlanOutcome::kBlocked);
}

/// Where the robot came back to an earlier pose the traversed path has a small jump.
TEST(Retrace, CrossesJumpsAsLargeAsTheAccuracyOfAPath) {
  auto traversed = line(0.0, -2.0);
  for (const Pose2& pose : line(-2.2, -4.0)) traversed.push_back({pose.x, 0.08, 0.08});
  EXPECT_GT(retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM).reached_m, 3.9);
}

/// Across a smooth tunnel scan matching errs to and fro: a robot that drove so was 8 m from home,
/// and no path led back.
TEST(Retrace, FollowsAPathThatJitters) {
  auto traversed = line(0.0, -0.8);
  for (const Pose2& pose : line(-0.6, 0.6)) traversed.push_back(pose);
  for (std::size_t i = 1; i < traversed.size(); ++i) traversed[i].y = 0.16;
  const PlannedPath path = retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_GT(path.reached_m, 0.8 + 1.4);
  EXPECT_TRUE(path.points.front().reverse);
  EXPECT_FALSE(path.points.back().reverse);
}

/// A map correction moves what was driven long ago, and tears the traversed path.
TEST(Retrace, CurvesOntoAPathBesideIt) {
  auto traversed = line(0.0, -2.0);
  for (const Pose2& pose : line(-2.2, -6.0)) traversed.push_back({pose.x, 0.25, 0.1});
  for (const double radius_m : {0.5, 1.6}) {
    const PlannedPath path = retrace(retrace_goal(traversed), {0, 0, 0}, radius_m);
    ASSERT_GT(path.reached_m, 5.9) << radius_m;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      EXPECT_TRUE(path.points[i].reverse);
      EXPECT_LE(std::abs(path.points[i].curvature_1_m), 1.05 / radius_m);
      EXPECT_GE(path.points[i].T_odom_body.y, -0.01);
      EXPECT_LE(path.points[i].T_odom_body.y, 0.26);
    }
  }
}

/// What the vehicle cannot turn ends the path.
TEST(Retrace, EndsBeforeATurnThatIsTooTight) {
  auto traversed = line(0.0, -2.0);
  const Pose2 bend = traversed.back() * along_arc(-0.3, 1.2);
  traversed.push_back(bend);
  for (int i = 1; i <= 10; ++i) traversed.push_back(bend * Pose2{-0.2 * i, 0.0, 0.0});
  EXPECT_NEAR(retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM).reached_m, 2.0, 1e-9);
  EXPECT_GT(retrace(retrace_goal(traversed), {0, 0, 0}, 0.24).reached_m, 4.1);
}

class Rejoin : public testing::Test {
 protected:
  /// A drive in along x and back out in reverse, 1 m beside it; the robot is at its start.
  static PlanGoal beside_the_traversed_path() {
    PlanGoal goal = retrace_goal({});
    goal.kind = PlanGoal::Kind::kRejoin;
    goal.distance_m = 3.0;
    goal.route_odom = {{0.0, 0.0}, {-5.0, 0.0}};
    for (const Pose2& pose : line(0.0, 10.0)) goal.traversed_path_odom.push_back(pose);
    for (const Pose2& pose : line(9.8, -6.0)) {
      goal.traversed_path_odom.push_back({pose.x, kBesideM, 0.0});
    }
    return goal;
  }
  static PlannedPath plan(const TerrainMap& terrain) {
    static Planning planning{PlanningParams{}};
    return planning.plan(terrain, beside_the_traversed_path(), {0, 0, 0});
  }

  static constexpr double kBesideM = 1.0;
};

/// The robot does not follow the latest part of the traversed path into the mine first.
TEST_F(Rejoin, LeadsOntoTheTraversedPathWhereItIsFarthestBack) {
  const PlannedPath path = plan(even_ground());
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  const Pose2& end = path.points.back().T_odom_body;
  EXPECT_NEAR(end.y, kBesideM, 1e-9);  // a pose of the traversed path itself
  EXPECT_LT(end.x, -3.0);
  double x_max_m = 0.0;
  for (const PathPoint& point : path.points) x_max_m = std::max(x_max_m, point.T_odom_body.x);
  EXPECT_LT(x_max_m, 2.0);  // room to turn out
}

/// If no observed ground leads to the farthest part, the latest part is retraced.
TEST_F(Rejoin, RetracesWhereNoOtherPathIsObserved) {
  TerrainMap terrain = even_ground();
  paint_box(terrain, obstacle_cell(1.0), {-12.0, 0.65}, {12.0, 0.8});
  const PlannedPath path = plan(terrain);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 3.0, 0.2);  // distance_m, and at most one pose more
  for (const PathPoint& point : path.points) EXPECT_NEAR(point.T_odom_body.y, 0.0, 0.11);
  EXPECT_NEAR(path.points.back().T_odom_body.x, 3.0, 0.25);
}

/// An obstacle may block the start pose, but not the traversed path.
TEST_F(Rejoin, NeedsNoObservedGroundOnTheTraversedPath) {
  TerrainMap terrain = even_ground();
  paint_box(terrain, obstacle_cell(1.0), {-12.0, -12.0}, {12.0, 12.0});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kFound);
}

TEST(Retrace, IsBlockedWithoutATraversedPath) {
  for (const auto& traversed : {std::vector<Pose2>{}, line(0.0, -0.2), line(-2.0, -4.0)}) {
    const PlannedPath path = retrace(retrace_goal(traversed), {0, 0, 0}, kTurningRadiusM);
    EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
    EXPECT_TRUE(path.points.empty());
    EXPECT_FALSE(path.reason.empty());
  }
}

}  // namespace
}  // namespace adit
