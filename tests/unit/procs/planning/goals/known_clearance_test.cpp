// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/known_clearance.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/types/vehicle.hpp"
#include "procs/planning/goals/retrace.hpp"

namespace adit {
namespace {

/// Along the x axis, 0.2 m from point to point, with 0.6 m of clearance and less in the middle.
PlannedPath planned(double from_m, double to_m) {
  PlannedPath path;
  path.outcome = PlanOutcome::kFound;
  for (double x = from_m; x <= to_m; x += 0.2) {
    const double clearance_m = std::abs(x - 2.0) < 0.3 ? 0.05 : 0.6;
    path.points.push_back({{x, 0.0, 0.0}, 0.0, false, clearance_m, 0.0});
  }
  return path;
}

/// Back along the x axis, from the body.
PlannedPath back(double from_m, double to_m) {
  PlanGoal goal;
  goal.kind = PlanGoal::Kind::kRetrace;
  for (double x = from_m; x >= to_m; x -= 0.1) goal.traversed_path_odom.push_back({x, 0.02, 0.01});
  return retrace(goal, goal.traversed_path_odom.front(), Vehicle{}.turning_radius_m);
}

TEST(KnownClearance, IsThatOfThePlannedPath) {
  KnownClearance known;
  known.add_path(planned(0.0, 5.0));
  PlannedPath path = back(5.0, 0.0);
  known.apply(path);
  ASSERT_GT(path.points.size(), 10U);
  for (const PathPoint& point : path.points) {
    const double from_middle_m = std::abs(point.T_odom_body.x - 2.0);
    if (from_middle_m > 0.2 && from_middle_m < 0.6) continue;  // both are near
    EXPECT_EQ(point.clearance_m, from_middle_m < 0.4 ? 0.05 : 0.6) << point.T_odom_body.x;
  }
}

TEST(KnownClearance, IsNotThatOfPointsOverAScan) {
  KnownClearance known;
  known.add_path(planned(0.0, 5.0));
  PlannedPath path = planned(0.0, 5.0);
  for (PathPoint& point : path.points) point.clearance_m = 0.04;
  known.apply(path);
  for (const PathPoint& point : path.points) EXPECT_EQ(point.clearance_m, 0.04);
}

TEST(KnownClearance, StaysSmallWhereNoPathWasPlanned) {
  KnownClearance known;
  known.add_path(planned(4.0, 8.0));
  PlannedPath path = back(3.0, 0.0);
  known.apply(path);
  for (const PathPoint& point : path.points) EXPECT_EQ(point.clearance_m, 0.1);
  EXPECT_FALSE(known.at({5.0, 0.0, 1.0}));  // there, but across
}

TEST(KnownClearance, IsTheSameWithTheOtherEndAhead) {
  KnownClearance known;
  known.add_path(planned(0.0, 5.0));
  EXPECT_EQ(known.at({3.0, 0.0, std::numbers::pi}), 0.6);
  EXPECT_EQ(known.at({3.0, 0.0, -std::numbers::pi + 0.1}), 0.6);
  EXPECT_FALSE(known.at({3.0, 0.0, std::numbers::pi / 2.0}));
}

TEST(KnownClearance, IgnoresPathsThatWereNotFound) {
  KnownClearance known;
  PlannedPath path = planned(0.0, 5.0);
  path.outcome = PlanOutcome::kBlocked;
  known.add_path(path);
  EXPECT_FALSE(known.at({3.0, 0.0, 0.0}));
}

/// A loop closure moves odom in map by half a metre: the traversed path of long ago moves in odom.
TEST(KnownClearance, KeepsItsPlaceInMap) {
  KnownClearance known;
  known.set_correction({1.0, 2.0, 0.0});
  known.add_path(planned(0.0, 5.0));
  for (double x = 0.0; x <= 20.0; x += 0.1) known.add_pose({x, 0.0, 0.0});
  known.add_path(planned(20.0, 22.0));
  known.set_correction({1.0, 1.5, 0.0});
  EXPECT_FALSE(known.at({1.0, 0.0, 0.0}));
  EXPECT_EQ(known.at({1.0, 0.5, 0.0}), 0.6);
  EXPECT_EQ(known.at({21.0, 0.0, 0.0}), 0.6);  // planned since the newest local map
  EXPECT_FALSE(known.at({21.0, 0.5, 0.0}));
}

TEST(KnownClearance, IsForgottenWithTheOdomFrame) {
  KnownClearance known;
  known.add_pose({4.0, 0.0, 0.0});
  known.add_path(planned(0.0, 5.0));
  known.add_pose({4.1, 0.0, 0.05});
  EXPECT_TRUE(known.at({3.0, 0.0, 0.0}));
  known.add_pose({});  // a restart of scan matching
  EXPECT_FALSE(known.at({3.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace adit
