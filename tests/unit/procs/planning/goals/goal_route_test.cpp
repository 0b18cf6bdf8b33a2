// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/goal_route.hpp"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(GoalRoute, FindsTheNearestPointOfADenseSampling) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
  constexpr double kStepM = 0.002;
  for (int round = 0; round < 20; ++round) {
    Points points;
    for (int i = 0; i < 5; ++i) points.emplace_back(coordinate(engine), coordinate(engine));
    const GoalRoute route(points);
    const Eigen::Vector2d p(coordinate(engine), coordinate(engine));
    double lateral_m = 1e9;
    double s_m = 0.0;
    double distance_m = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double leg_m = (points[i + 1] - points[i]).norm();
      const bool last = i + 2 == points.size();
      for (double s = 0.0; s <= (last ? leg_m + 20.0 : leg_m); s += kStepM) {
        const double sample_m = (points[i] + s / leg_m * (points[i + 1] - points[i]) - p).norm();
        if (sample_m >= lateral_m) continue;
        lateral_m = sample_m;
        s_m = distance_m + s;
      }
      distance_m += leg_m;
    }
    const GoalRoute::Projection nearest = route.nearest(p);
    EXPECT_NEAR(nearest.lateral_m, lateral_m, kStepM);
    EXPECT_NEAR(nearest.s_m, s_m, 0.1);  // the distance is flat near its minimum
    EXPECT_NEAR(route.length_m(), distance_m, 1e-9);
    EXPECT_NEAR(nearest.tangent.norm(), 1.0, 1e-12);
  }
}

TEST(GoalRoute, LeavesOutDuplicatePoints) {
  EXPECT_TRUE(GoalRoute(Points{{1, 1}, {1, 1}, {1, 1}}).empty());
  EXPECT_TRUE(GoalRoute(Points{{1, 1}}).empty());
  const GoalRoute route(Points{{0, 0}, {0, 0}, {2, 0}, {2, 0}});
  EXPECT_DOUBLE_EQ(route.length_m(), 2.0);
  EXPECT_DOUBLE_EQ(route.nearest({1.5, 1.0}).s_m, 1.5);
}

TEST(GoalRoute, HasThePointAtAnArcLength) {
  const GoalRoute route(Points{{0, 0}, {2, 0}, {2, 1}});
  EXPECT_LT((route.point(0.0) - Eigen::Vector2d(0, 0)).norm(), 1e-12);
  EXPECT_LT((route.point(1.5) - Eigen::Vector2d(1.5, 0)).norm(), 1e-12);
  EXPECT_LT((route.point(2.0) - Eigen::Vector2d(2, 0)).norm(), 1e-12);
  EXPECT_LT((route.point(2.5) - Eigen::Vector2d(2, 0.5)).norm(), 1e-12);
  EXPECT_LT((route.point(5.0) - Eigen::Vector2d(2, 3)).norm(), 1e-12);
}

/// A tunnel along x, 3 m wide, and another across it at x = 6 m, to the left or to both sides.
TerrainMap crossing(bool both_sides) {
  TerrainMap terrain = even_ground();
  paint(terrain, obstacle_cell(2.0), [&](const Eigen::Vector2d& p) {
    const bool along = std::abs(p.y()) < 1.5 && p.x() < (both_sides ? 20.0 : 7.5);
    const bool across = std::abs(p.x() - 6.0) < 1.5 && (both_sides || p.y() > -1.5);
    return !along && !across;
  });
  return terrain;
}

PlannedPath plan_along(const TerrainMap& terrain, const Points& route,
                       PlanGoal::Kind kind = PlanGoal::Kind::kRoute, double heading_rad = 0.0) {
  PlanGoal goal;
  goal.kind = kind;
  goal.route_odom = route;
  const Pose2 T_odom_body{route.front().x(), route.front().y(), heading_rad};
  return Planning(PlanningParams{}).plan(terrain, goal, T_odom_body);
}

/// To the end of a route, which must be reached.
PlannedPath plan_to_end(const TerrainMap& terrain, const Points& route, double heading_rad = 0.0) {
  return plan_along(terrain, route, PlanGoal::Kind::kRouteTo, heading_rad);
}

void expect_end(const PlannedPath& path, const Eigen::Vector2d& p_odom, double within_m) {
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_LE((path.points.back().T_odom_body.translation() - p_odom).norm(), within_m);
}

TEST(PlanningAlongARoute, FollowsABend) {
  // Within 1.5 m, route_offset_max_m: the end may be short of the goal or beside it, by its cost.
  expect_end(plan_along(crossing(false), {{0, 0}, {5, 0}, {6, 1}, {6, 7}}), {6, 7}, 1.5);
}

TEST(PlanningAlongARoute, TurnsIntoTheBranchOfTheRoute) {
  const TerrainMap terrain = crossing(true);
  expect_end(plan_along(terrain, {{0, 0}, {5, 0}, {6, 1}, {6, 7}}), {6, 7}, 1.5);
  expect_end(plan_along(terrain, {{0, 0}, {5, 0}, {6, -1}, {6, -7}}), {6, -7}, 1.5);
  expect_end(plan_along(terrain, {{0, 0}, {8, 0}}), {8, 0}, 0.3);
}

TEST(PlanningAlongARoute, EndsAtTheEndOfTheRoute) {
  for (const double length_m : {1.0, 2.0, 4.0}) {
    expect_end(plan_along(crossing(true), {{0, 0}, {length_m, 0}}), {length_m, 0}, 0.3);
  }
}

TEST(PlanningAlongARoute, IsBlockedByAWall) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, obstacle_cell(2.0), {3.0, -2.0}, {3.5, 2.0});
  const PlannedPath path = plan_along(terrain, {{0, 0}, {8, 0}});
  EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
  EXPECT_LE(path.reached_m, 3.0 - 1.2 + 0.1);  // half a vehicle before it, and a cell
}

/// The first segment leads from the robot to the middle of the tunnel, and towards its wall.
TEST(PlanningAlongARoute, IsBlockedByTheWaterAheadNotByTheWallBesideIt) {
  for (const double start_m : {-0.3, 0.3}) {
    TerrainMap terrain = crossing(true);
    for (const double y : {-1.5, 1.1}) {
      paint_box(terrain, obstacle_cell(2.0), {-2.0, y}, {9.0, y + 0.4});
    }
    paint_box(terrain, unmeasured_cell(Ground::kNoReturn), {1.8, -1.1}, {9.0, 1.1});
    const PlannedPath path = plan_along(terrain, {{0, start_m}, {0.6, 0}, {12, 0}});
    ASSERT_EQ(path.outcome, PlanOutcome::kBlocked);
    EXPECT_NE(path.reason.find("possible water"), std::string::npos) << path.reason;
  }
}

/// The diagonal of half a cell, and a quarter of it for which another 0.1 m of path does not pay.
constexpr double kReachedM = 0.1;

TEST(PlanningToTheEndOfARoute, IsReachedFromAnyDistanceForwardsAndInReverse) {
  for (const double heading_rad : {0.0, 3.1}) {
    for (const double length_m : {1.0, 2.0, 4.0, 8.0}) {
      expect_end(plan_to_end(crossing(true), {{0, 0}, {length_m, 0}}, heading_rad), {length_m, 0},
                 kReachedM);
    }
  }
}

/// A path along a route may end beside it, and 1.5 m in front of a wall; one to its end may not.
TEST(PlanningToTheEndOfARoute, IsReachedBesideTheAxisOfATunnelAndInFrontOfAWall) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, obstacle_cell(2.0), {8.0, -2.0}, {8.5, 2.0});
  expect_end(plan_to_end(terrain, {{0, 0}, {6.0, 0.3}}), {6.0, 0.3}, kReachedM);
}

TEST(PlanningToTheEndOfARoute, IsReachedFromBesideItByChangesOfDirection) {
  const PlannedPath path = plan_to_end(crossing(true), {{0, 0.45}, {0, 0}});
  expect_end(path, {0, 0}, 0.35);  // at least 0.1 m closer
  bool forwards = false;
  bool backwards = false;
  for (const PathPoint& point : path.points) (point.reverse ? backwards : forwards) = true;
  EXPECT_TRUE(forwards && backwards);
}

TEST(PlanningToTheEndOfARoute, IsApproachedAsCloseAsAnObstacleAllows) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, obstacle_cell(2.0), {6.1, -2.0}, {6.4, 2.0});
  // Half its length from the obstacle, and a margin: at least 0.3 m short of the end.
  const PlannedPath path = plan_to_end(terrain, {{0, 0}, {5.2, 0}});
  expect_end(path, {5.2, 0}, 0.5);
  EXPECT_LT(path.points.back().T_odom_body.x, 6.1 - 1.2 + 0.05);  // half a cell
}

TEST(PlanningToTheEndOfARoute, HasNoPathThatComesNoCloser) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, obstacle_cell(2.0), {1.25, -2.0}, {1.6, 2.0});
  paint_box(terrain, obstacle_cell(2.0), {-8.0, 0.9}, {1.6, 1.2});  // too narrow to turn
  paint_box(terrain, obstacle_cell(2.0), {-8.0, -1.2}, {1.6, -0.9});
  EXPECT_NE(plan_to_end(terrain, {{0, 0}, {0.4, 0}}).outcome, PlanOutcome::kFound);
  EXPECT_NE(plan_to_end(terrain, {{0, 0}, {0, 0}}).outcome, PlanOutcome::kFound);
}

TEST(PlanningToTheEndOfARoute, IsApproachedAsFarAsTheGroundIsObserved) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, unmeasured_cell(Ground::kOccluded), {6.0, -2.0}, {10.0, 2.0});
  const PlannedPath path = plan_to_end(terrain, {{0, 0}, {8.0, 0}});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_GT(path.reached_m, 2.5);  // min_progress_m
  EXPECT_LT(path.reached_m, 6.0);
}

}  // namespace
}  // namespace adit
