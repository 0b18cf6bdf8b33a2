// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Drives along the traversed path without a 3D scan.
#include <gtest/gtest.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

/// 20 m into the mine, after a scan there.
class MissionInTransit : public ScriptedStages {
 protected:
  void SetUp() override {
    to_execute();
    drive(20.0);
    arrive();
    answer(Kind::kGoTo);
    terrain();
    path(PlanOutcome::kFound);
    arrive();
    ASSERT_EQ(now(), Phase::kExplore);
    ASSERT_EQ(scans_, 2);
  }
};

TEST_F(MissionInTransit, DrivesBackAlongTheTraversedPathWithoutAScan) {
  reach_m_ = -12.0;
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  EXPECT_NEAR(goal_.distance_m, 12.0 - 1.5, 0.7);  // to before the end of the route
  EXPECT_EQ(phase().laser, LaserId::kRear);
}

TEST_F(MissionInTransit, ScansWhereItHasNotBeen) {
  reach_m_ = 12.0;
  answer(Kind::kGoTo, 1);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionInTransit, ScansAfterADriveWithoutScansThatFailed) {
  reach_m_ = -12.0;
  answer(Kind::kHome);
  path(PlanOutcome::kFound);
  driving(DrivingState::Kind::kFailed, "held by a stop order, no progress for 10 s");
  tick();
  ASSERT_EQ(now(), Phase::kExplore);
  answer(Kind::kHome);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionInTransit, ScansAfterThirtyMetresWithoutAScan) {
  reach_m_ = 20.0;
  answer(Kind::kGoTo, 1);
  terrain();
  path(PlanOutcome::kFound);
  drive(28.0);
  arrive();
  reach_m_ = -12.0;
  answer(Kind::kHome);
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  ASSERT_EQ(now(), Phase::kPlan);
  tick();
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);  // and continues along the traversed path
  ASSERT_FALSE(goal_.traversed_path_odom.empty());
  const Eigen::Vector2d back = goal_.traversed_path_odom.back().translation() -
                               goal_.traversed_path_odom.front().translation();
  EXPECT_NEAR(back.norm(), 12.0 - 1.5, 0.7);  // no pose beyond the end of the route
}

}  // namespace
}  // namespace adit
