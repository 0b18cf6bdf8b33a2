// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The last metres home: as near to the start as possible, with a limited number of tries.
#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class MissionNearHome : public ScriptedStages {
 protected:
  /// Exploration leads home, the origin of odom, over this distance.
  void lead_home(double from_m) {
    x_m_ = from_m;
    reach_m_ = -from_m;
    tick();
    if (now() != Phase::kExplore) to_explore();
    answer(Kind::kHome);
  }
};

TEST_F(MissionNearHome, PlansToTheStartIfTheRouteEndsThere) {
  lead_home(8.0);
  terrain();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRouteTo);
  EXPECT_EQ(goal_.route_odom.back(), Eigen::Vector2d(0.0, 0.0));
}

TEST_F(MissionNearHome, FollowsTheRouteIfItEndsBefore) {
  x_m_ = 30.0;
  reach_m_ = -12.0;
  to_scan(Kind::kHome);
  terrain();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
}

TEST_F(MissionNearHome, EndsAtHomeIfNoPathLeadsNearer) {
  lead_home(0.4);
  for (const LaserId laser : {LaserId::kRear, LaserId::kFront}) {
    ASSERT_EQ(now(), Phase::kScan);
    EXPECT_EQ(scan_.laser, laser);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_THAT(phase().reason, HasSubstr("at home, 0.40 m from the start, and gets no nearer"));
}

TEST_F(MissionNearHome, TriesTwiceToGetNearer) {
  for (int i = 0; i < 2; ++i) {
    lead_home(0.4);
    ASSERT_EQ(now(), Phase::kScan) << i;
    terrain();
    path(PlanOutcome::kFound);
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
  }
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_EQ(phase().scans, 2);
}

TEST_F(MissionNearHome, DoesNotAcceptAMetreAsHome) {
  lead_home(1.0);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_NE(now(), Phase::kEnded);
}

}  // namespace
}  // namespace adit
