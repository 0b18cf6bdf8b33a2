// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/patrol.hpp"

#include <gtest/gtest.h>

#include "tests/support/robots/exploring_robot.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

const std::vector<PatrolPlace> kPlaces{{0, {0.0, 0.0}}, {1, {5.0, 0.0}}, {2, {10.0, 0.0}}};

ExplorationParams on_patrol() {
  ExplorationParams params;
  params.patrol = true;
  return params;
}

TEST(Patrol, SelectsThePlaceVisitedLongestAgo) {
  Patrol patrol;
  patrol.pass(kPlaces, {0.0, 0.5}, 1);
  patrol.pass(kPlaces, {10.0, 0.0}, 2);
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 1);  // never passed
  patrol.pass(kPlaces, {5.0, 0.0}, 3);
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 0);
  EXPECT_FALSE(patrol.next({}));
}

TEST(Patrol, RetainsItsGoalUntilItIsPassed) {
  Patrol patrol;
  patrol.pass(kPlaces, {0.0, 0.0}, 1);
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 1);
  patrol.pass(kPlaces, {1.9, 0.0}, 2);  // 3.1 m from it
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 1);
  patrol.pass(kPlaces, {2.1, 0.0}, 3);
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 2);
}

TEST(Patrol, SelectsAnotherPlaceIfOneIsUnreachable) {
  Patrol patrol;
  patrol.mark_unreachable(0, 1);
  EXPECT_EQ(patrol.next(kPlaces)->local_map, 1);
}

/// The crossroads have 85 m of tunnel: exploring them takes less than 250 m.
TEST(PatrolInAMine, ContinuesUntilTheBudgetRequiresTheReturn) {
  const auto mine = tunnel_mine(crossroads());
  Exploration explored{ExplorationParams{}};
  const auto once = test::run_exploration(mine, explored, 1000.0);
  Exploration patrolled{on_patrol()};
  const auto often = test::run_exploration(mine, patrolled, 1000.0);
  EXPECT_TRUE(often.returned) << often.distance_from_start_m;
  EXPECT_TRUE(often.complete);
  EXPECT_EQ(often.missed_m, 0.0);
  EXPECT_LT(once.distance_travelled_m, 250.0);
  // Retained: the reserve, half of the path home, and the last place at 55 m from home.
  EXPECT_GT(often.distance_travelled_m, 850.0);
  EXPECT_LE(often.distance_travelled_m, 1000.0);
}

TEST(PatrolInAMine, PassesEveryPlaceRepeatedly) {
  const auto mine = tunnel_mine(crossroads());
  Exploration exploration{on_patrol()};
  const auto run = test::run_exploration(mine, exploration, 1000.0);
  for (const Eigen::Vector2d& end :
       {Eigen::Vector2d(41.0, 0.0), Eigen::Vector2d(22.0, 18.0), Eigen::Vector2d(22.0, -18.0)}) {
    int visits = 0;
    bool was_near = false;
    for (const Eigen::Vector2d& p_map : run.path_map) {
      const bool near = (p_map - end).norm() < 13.0;  // range of 8 m, and a local map of 5 m
      visits += near && !was_near ? 1 : 0;
      was_near = near;
    }
    EXPECT_GE(visits, 4) << end.transpose();  // a round is 170 m
  }
}

TEST(PatrolInAMine, SkipsAPlaceToWhichThePlannerFindsNoPath) {
  const auto mine = tunnel_mine(straight());
  Exploration exploration{on_patrol()};
  test::ExploringRobot robot(mine);
  const auto decide = [&] {
    EXPECT_TRUE(exploration.add(robot.last_map()));
    EXPECT_TRUE(exploration.update(robot.graph()));
    return exploration.decide({robot.utime(), robot.T_map_body(), 1000.0, 0.0});
  };
  ExplorationDecision decision = decide();
  for (int i = 0; i < 30 && decision.frontier != ExplorationDecision::kNoFrontier; ++i) {
    robot.drive(exploration.route(), 5.0);
    decision = decide();
  }
  ASSERT_EQ(decision.kind, ExplorationDecision::Kind::kGoTo);
  ASSERT_EQ(decision.frontier, ExplorationDecision::kNoFrontier);
  EXPECT_TRUE(exploration.report_blocked(ExplorationDecision::kNoFrontier,
                                         {robot.utime(), 0.5, "A.", false}));
  const ExplorationDecision other = decide();
  EXPECT_EQ(other.kind, ExplorationDecision::Kind::kGoTo);
  EXPECT_NE(other.reason, decision.reason);
}

}  // namespace
}  // namespace adit
