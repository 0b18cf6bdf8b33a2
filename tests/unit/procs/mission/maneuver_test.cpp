// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/maneuver.hpp"

#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

const std::vector<Eigen::Vector2d> kRouteOdom{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}};
const std::vector<Pose2> kBackOdom{{0.0, 0.0, 0.0}, {-1.0, 0.0, 0.1}, {-2.0, 0.5, 0.2}};

TEST(Maneuver, FollowsTheRouteAndEndsAtHome) {
  EXPECT_EQ(goal_of(FollowRoute{}, {kRouteOdom, false}).kind, PlanGoal::Kind::kRoute);
  const PlanGoal home = goal_of(FollowRoute{}, {kRouteOdom, true});
  EXPECT_EQ(home.kind, PlanGoal::Kind::kRouteTo);
  EXPECT_EQ(home.T_odom_goal, Pose2(4.0, 4.0, 0.0));
}

TEST(Maneuver, PlansOverTheTerrainOfOneScanOnly) {
  const std::vector<Eigen::Vector2d> far_odom{{0.0, 0.0}, {30.0, 0.0}};
  const PlanGoal goal = goal_of(FollowRoute{}, {far_odom, true});
  EXPECT_EQ(goal.kind, PlanGoal::Kind::kRoute);  // home is beyond the range of the scan
  EXPECT_EQ(goal.route_odom.back(), Eigen::Vector2d(12.0, 0.0));
  const PlanGoal rejoin = goal_of(Rejoin{PlanGoal::Kind::kRejoin, 6.0, kBackOdom, {}}, {far_odom});
  EXPECT_EQ(rejoin.route_odom.back(), Eigen::Vector2d(12.0, 0.0));
}

TEST(Maneuver, ApproachesAlongTheFirstPartOfTheRoute) {
  const PlanGoal goal = goal_of(Approach{5.0}, {kRouteOdom});
  EXPECT_EQ(goal.kind, PlanGoal::Kind::kRouteTo);
  ASSERT_EQ(goal.route_odom.size(), 3U);
  EXPECT_EQ(goal.route_odom.back(), Eigen::Vector2d(4.0, 1.0));
}

TEST(Maneuver, BacksOffOverTheTraversedPath) {
  const PlanGoal goal =
      goal_of(BackOff{PlanGoal::Kind::kRetrace, 3.0, kBackOdom, {}}, {kRouteOdom});
  EXPECT_EQ(goal.kind, PlanGoal::Kind::kRetrace);
  EXPECT_EQ(goal.distance_m, 3.0);
  EXPECT_EQ(goal.traversed_path_odom, kBackOdom);
  EXPECT_EQ(goal.route_odom.back(), Eigen::Vector2d(-2.0, 0.5));
  EXPECT_EQ(goal.T_odom_goal, Pose2(-2.0, 0.5, 0.0));
}

TEST(Maneuver, RejoinsWithTheRouteToTheTarget) {
  const PlanGoal goal = goal_of(Rejoin{PlanGoal::Kind::kRejoin, 6.0, kBackOdom, {}}, {kRouteOdom});
  EXPECT_EQ(goal.route_odom, kRouteOdom);
  EXPECT_EQ(goal.traversed_path_odom, kBackOdom);
}

TEST(Maneuver, PlansOverTerrainOnceRetracingIsRejected) {
  const Maneuver retraces = BackOff{PlanGoal::Kind::kRetrace, 3.0, kBackOdom, {}};
  EXPECT_TRUE(uses_traversed_path(retraces));
  const auto planned = planned_instead_of_retraced(retraces);
  ASSERT_TRUE(planned);
  EXPECT_FALSE(uses_traversed_path(*planned));
  EXPECT_TRUE(is_off_route(*planned));
  EXPECT_FALSE(planned_instead_of_retraced(*planned));
  EXPECT_FALSE(planned_instead_of_retraced(FollowRoute{}));
}

TEST(Maneuver, OnlyARejoinOverTerrainLeadsTowardsTheTarget) {
  EXPECT_FALSE(leads_away(FollowRoute{}));
  EXPECT_FALSE(leads_away(Rejoin{PlanGoal::Kind::kRejoin, 6.0, kBackOdom, {}}));
  EXPECT_TRUE(leads_away(Rejoin{PlanGoal::Kind::kRetrace, 6.0, kBackOdom, {}}));
  EXPECT_TRUE(leads_away(BackOff{PlanGoal::Kind::kRetrace, 3.0, kBackOdom, {}}));
}

}  // namespace
}  // namespace adit
