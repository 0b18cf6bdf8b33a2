// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/retrace.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kRadiusM = 4.0;

PlanGoal back_on(std::vector<Pose2> track) {
  PlanGoal goal;
  goal.utime = 7;
  goal.id = 3;
  goal.kind = PlanGoal::Kind::kRetrace;
  goal.traversed_path_odom = std::move(track);
  return goal;
}

/// The track of a body that came along a circle to the left, from it back.
std::vector<Pose2> circle(double distance_m) {
  std::vector<Pose2> track;
  for (double s = 0.0; s <= distance_m; s += 0.2) {
    const double angle = s / kRadiusM;
    track.push_back({-kRadiusM * std::sin(angle), kRadiusM * (1.0 - std::cos(angle)), -angle});
  }
  return track;
}

/// Straight along x from one place to another, with a heading.
std::vector<Pose2> line(double from_m, double to_m, double heading = 0.0) {
  std::vector<Pose2> track;
  const int steps = static_cast<int>(std::lround(std::abs(to_m - from_m) / 0.2));
  for (int i = 0; i <= steps; ++i) {
    track.push_back({from_m + (to_m - from_m) * i / steps, 0.0, heading});
  }
  return track;
}

TEST(Retrace, GoesStraightBackInReverse) {
  const PlannedPath path = retrace(back_on(line(0.0, -3.0)), {0, 0, 0});
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

TEST(Retrace, GoesForwardsWhereItCameInReverse) {
  const PlannedPath path = retrace(back_on(line(0.0, 2.0)), {0, 0, 0.05});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  for (const PathPoint& point : path.points) EXPECT_FALSE(point.reverse);
}

TEST(Retrace, KeepsToABend) {
  const auto track = circle(5.0);
  const PlannedPath path = retrace(back_on(track), {0, 0, 0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  ASSERT_EQ(path.points.size(), track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    EXPECT_EQ(path.points[i].T_odom_body, track[i]);
    EXPECT_TRUE(path.points[i].reverse);
    if (i + 1 == track.size()) continue;
    EXPECT_NEAR(path.points[i].curvature_1_m, 1.0 / kRadiusM, 1e-3);  // of the chord: 0.04 %
  }
}

/// As a robot that turned in three pieces.
TEST(Retrace, TurnsWhereItTurned) {
  auto track = line(0.0, -2.0);
  for (const Pose2& pose : line(-1.8, 1.0)) track.push_back(pose);
  const PlannedPath path = retrace(back_on(track), {0, 0, 0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 5.0, 1e-9);
  EXPECT_NEAR(path.points.back().T_odom_body.x, 1.0, 1e-9);
  for (std::size_t i = 0; i < path.points.size(); ++i) EXPECT_EQ(path.points[i].reverse, i < 10);
}

TEST(Retrace, GoesNoFartherThanItIsTo) {
  PlanGoal goal = back_on(line(0.0, -8.0));
  goal.distance_m = 3.0;
  EXPECT_NEAR(retrace(goal, {0, 0, 0}).reached_m, 3.0, 1e-9);
}

/// A track of which only parts are near leads to the first gap.
TEST(Retrace, EndsAtAGap) {
  auto track = line(0.0, -2.0);
  for (const Pose2& pose : line(-4.0, -6.0)) track.push_back(pose);
  EXPECT_NEAR(retrace(back_on(track), {0, 0, 0}).reached_m, 2.0, 1e-9);
}

class Rejoining : public testing::Test {
 protected:
  /// A way in along x and back out in reverse, 1 m beside it; the robot is at its end.
  static PlanGoal beside_the_way_in() {
    PlanGoal goal = back_on({});
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
    return planning.plan(terrain, beside_the_way_in(), {0, 0, 0});
  }

  static constexpr double kBesideM = 1.0;
};

/// Not all the way into the mine first, from where it came last.
TEST_F(Rejoining, LeadsOntoTheTrackWhereThatIsNearestToHome) {
  const PlannedPath path = plan(even_ground());
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  const Pose2& end = path.points.back().T_odom_body;
  EXPECT_NEAR(end.y, kBesideM, 1e-9);  // a pose of the track itself
  EXPECT_LT(end.x, -3.0);
  double most_m = 0.0;
  for (const PathPoint& point : path.points) most_m = std::max(most_m, point.T_odom_body.x);
  EXPECT_LT(most_m, 2.0);  // room to turn out
}

/// Where nothing that is seen leads to the track, what it came over last does.
TEST_F(Rejoining, GoesBackWhereItCameFromWhereNothingElseIsSeen) {
  TerrainMap terrain = even_ground();
  paint_box(terrain, obstacle_cell(1.0), {-12.0, 0.65}, {12.0, 0.8});
  const PlannedPath path = plan(terrain);
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 3.0, 0.2);  // of the track, and a piece of it more at most
  for (const PathPoint& point : path.points) EXPECT_NEAR(point.T_odom_body.y, 0.0, 0.11);
  EXPECT_NEAR(path.points.back().T_odom_body.x, 3.0, 0.25);
}

/// Its start may be refused for what it stands beside, its track never.
TEST_F(Rejoining, NeedsNoGroundToGoBackOverItsTraversedPath) {
  TerrainMap terrain = even_ground();
  paint_box(terrain, obstacle_cell(1.0), {-12.0, -12.0}, {12.0, 12.0});
  EXPECT_EQ(plan(terrain).outcome, PlanOutcome::kFound);
}

TEST(Retrace, IsNoneWithoutATrack) {
  for (const auto& track : {std::vector<Pose2>{}, line(0.0, -0.2), line(-2.0, -4.0)}) {
    const PlannedPath path = retrace(back_on(track), {0, 0, 0});
    EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
    EXPECT_TRUE(path.points.empty());
    EXPECT_FALSE(path.reason.empty());
  }
}

}  // namespace
}  // namespace adit
