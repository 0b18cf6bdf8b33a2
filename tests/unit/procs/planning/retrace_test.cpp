// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/retrace.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kRadiusM = 4.0;

PlanGoal back_on(std::vector<Eigen::Vector2d> track) {
  PlanGoal goal;
  goal.utime = 7;
  goal.id = 3;
  goal.kind = PlanGoal::Kind::kRetrace;
  goal.route_odom = std::move(track);
  return goal;
}

/// The track of a body that came along a circle to the left, from it back.
std::vector<Eigen::Vector2d> circle(double way_m) {
  std::vector<Eigen::Vector2d> track;
  for (double s = 0.0; s <= way_m; s += 0.2) {
    track.emplace_back(-kRadiusM * std::sin(s / kRadiusM),
                       kRadiusM * (1.0 - std::cos(s / kRadiusM)));
  }
  return track;
}

TEST(Retrace, GoesStraightBackInReverse) {
  const PlannedPath path = retrace(back_on({{0, 0}, {-1, 0}, {-2, 0}, {-3, 0}}), {0, 0, 0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_EQ(path.id, 3);
  EXPECT_NEAR(path.reached_m, 3.0, 1e-9);
  for (const PathPoint& point : path.points) {
    EXPECT_TRUE(point.reverse);
    EXPECT_NEAR(point.T_odom_body.y, 0.0, 1e-9);
    EXPECT_NEAR(std::sin(point.T_odom_body.theta), 0.0, 1e-9);
    EXPECT_NEAR(point.curvature_1_m, 0.0, 1e-9);
  }
  EXPECT_NEAR(path.points.back().T_odom_body.x, -3.0, 1e-9);
}

TEST(Retrace, GoesForwardsWhereItCameInReverse) {
  const PlannedPath path = retrace(back_on({{0, 0}, {1, 0}, {2, 0}}), {0, 0, 0.05});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  for (const PathPoint& point : path.points) EXPECT_FALSE(point.reverse);
}

TEST(Retrace, KeepsToABend) {
  const PlannedPath path = retrace(back_on(circle(5.0)), {0, 0, 0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  const Eigen::Vector2d middle(0.0, kRadiusM);
  for (std::size_t i = 2; i + 2 < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    const Eigen::Vector2d off = point.T_odom_body.translation() - middle;
    EXPECT_NEAR(off.norm(), kRadiusM, 0.02);
    // On a circle to the left the body looks at right angles to its radius.
    EXPECT_NEAR(angle_diff(point.T_odom_body.theta, std::atan2(off.x(), -off.y())), 0.0, 0.02);
    EXPECT_TRUE(point.reverse);
    const bool inside = i > 4 && i + 6 < path.points.size();  // ends are smoothed with fewer
    if (!inside) continue;
    EXPECT_NEAR(std::abs(point.curvature_1_m), 1.0 / kRadiusM, 0.02);
  }
}

TEST(Retrace, EndsWhereTheTrackTurnsBackOnItself) {
  const PlannedPath path = retrace(back_on({{0, 0}, {-1, 0}, {-2, 0}, {-1.2, 0.3}}), {0, 0, 0});
  ASSERT_EQ(path.outcome, PlanOutcome::kFound);
  EXPECT_NEAR(path.reached_m, 2.0, 1e-9);
}

TEST(Retrace, IsNoneWithoutATrack) {
  for (const auto& track : {std::vector<Eigen::Vector2d>{}, {{0, 0}}, {{0, 0}, {-0.3, 0}}}) {
    const PlannedPath path = retrace(back_on(track), {0, 0, 0});
    EXPECT_EQ(path.outcome, PlanOutcome::kBlocked);
    EXPECT_TRUE(path.points.empty());
    EXPECT_FALSE(path.reason.empty());
  }
}

}  // namespace
}  // namespace adit
