// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goal_route.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "tests/support/terrain_scenes.hpp"

namespace adit {
namespace {

using Places = std::vector<Eigen::Vector2d>;

TEST(GoalRoute, GivesTheNearestPlaceAsASearchOverAllPlacesDoes) {
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  constexpr double kStepM = 0.002;
  for (int round = 0; round < 20; ++round) {
    Places points;
    for (int i = 0; i < 5; ++i) points.emplace_back(place(chance), place(chance));
    const GoalRoute route(points);
    const Eigen::Vector2d p(place(chance), place(chance));
    double least_m = 1e9;
    double s_m = 0.0;
    double way_m = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double leg_m = (points[i + 1] - points[i]).norm();
      const bool last = i + 2 == points.size();
      for (double on = 0.0; on <= (last ? leg_m + 20.0 : leg_m); on += kStepM) {
        const double off = (points[i] + on / leg_m * (points[i + 1] - points[i]) - p).norm();
        if (off >= least_m) continue;
        least_m = off;
        s_m = way_m + on;
      }
      way_m += leg_m;
    }
    const GoalRoute::Place nearest = route.nearest(p);
    EXPECT_NEAR(nearest.lateral_m, least_m, kStepM);
    EXPECT_NEAR(nearest.s_m, s_m, 0.1);  // flat near the least
    EXPECT_NEAR(route.length_m(), way_m, 1e-9);
    EXPECT_NEAR(nearest.tangent.norm(), 1.0, 1e-12);
  }
}

TEST(GoalRoute, LeavesOutPointsThatLieOnEachOther) {
  EXPECT_TRUE(GoalRoute(Places{{1, 1}, {1, 1}, {1, 1}}).empty());
  EXPECT_TRUE(GoalRoute(Places{{1, 1}}).empty());
  const GoalRoute route(Places{{0, 0}, {0, 0}, {2, 0}, {2, 0}});
  EXPECT_DOUBLE_EQ(route.length_m(), 2.0);
  EXPECT_DOUBLE_EQ(route.nearest({1.5, 1.0}).s_m, 1.5);
}

/// A drift of 3 m along x and, at x = 6 m, one across it, to the left or to both sides.
TerrainMap crossing(bool both_sides) {
  TerrainMap terrain = even_ground();
  paint(terrain, obstacle_cell(2.0), [&](const Eigen::Vector2d& p) {
    const bool along = std::abs(p.y()) < 1.5 && p.x() < (both_sides ? 20.0 : 7.5);
    const bool across = std::abs(p.x() - 6.0) < 1.5 && (both_sides || p.y() > -1.5);
    return !along && !across;
  });
  return terrain;
}

PlannedPath plan_along(const TerrainMap& terrain, const Places& route) {
  PlanGoal goal;
  goal.kind = PlanGoal::Kind::kRoute;
  goal.route_odom = route;
  return Planning(PlanningParams{}).plan(terrain, goal, {});
}

void expect_end(const PlannedPath& path, const Eigen::Vector2d& p_odom, double within_m) {
  ASSERT_EQ(path.outcome, PlanOutcome::kFound) << path.reason;
  EXPECT_LE((path.points.back().T_odom_body.translation() - p_odom).norm(), within_m);
}

TEST(PlanningAlongARoute, LeadsRoundABend) {
  // By 1.5 m, beside_route_max_m: it is short of the end or beside it, which costs more or less.
  expect_end(plan_along(crossing(false), {{0, 0}, {5, 0}, {6, 1}, {6, 7}}), {6, 7}, 1.5);
}

TEST(PlanningAlongARoute, LeadsIntoTheBranchThatIsMeant) {
  const TerrainMap terrain = crossing(true);
  expect_end(plan_along(terrain, {{0, 0}, {5, 0}, {6, 1}, {6, 7}}), {6, 7}, 1.5);
  expect_end(plan_along(terrain, {{0, 0}, {5, 0}, {6, -1}, {6, -7}}), {6, -7}, 1.5);
  expect_end(plan_along(terrain, {{0, 0}, {8, 0}}), {8, 0}, 0.3);
}

TEST(PlanningAlongARoute, EndsWhereTheRouteEnds) {
  for (const double length_m : {1.0, 2.0, 4.0}) {
    expect_end(plan_along(crossing(true), {{0, 0}, {length_m, 0}}), {length_m, 0}, 0.3);
  }
}

TEST(PlanningAlongARoute, SaysThatItIsBlockedBeforeAWall) {
  TerrainMap terrain = crossing(true);
  paint_box(terrain, obstacle_cell(2.0), {3.0, -2.0}, {3.5, 2.0});
  const PlannedPath path = plan_along(terrain, {{0, 0}, {8, 0}});
  EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
  EXPECT_LE(path.reached_m, 3.0 - 1.2 + 0.1);  // half a vehicle before it, and a cell
}

}  // namespace
}  // namespace adit
