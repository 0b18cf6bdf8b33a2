// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The sequence of a mission without obstacles, and with lost messages.
#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Driving = DrivingState::Kind;

class MissionTest : public ScriptedStages {};

TEST_F(MissionTest, ExploresScansPlansAndExecutes) {
  EXPECT_EQ(now(), Phase::kWaiting);
  to_explore();
  EXPECT_EQ(request_.id, 1);
  EXPECT_FALSE(request_.returning_home);
  to_scan();
  EXPECT_EQ(phase().frontier, 0);
  EXPECT_EQ(phase().reason, "because");
  EXPECT_EQ(scan_.id, phase().goal_id);
  EXPECT_EQ(scan_.laser, LaserId::kFront);
  to_plan();
  EXPECT_EQ(phase().scans, 1);
  EXPECT_EQ(goal_.id, phase().goal_id);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
  EXPECT_EQ(goal_.route_odom.back(), Eigen::Vector2d(10.0, 0.0));
  to_execute();
  drive(10.0);
  arrive();
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_EQ(request_.id, 2);
  EXPECT_NEAR(phase().distance_travelled_m, 10.0, 0.2);  // spacing of stored poses
}

TEST_F(MissionTest, WaitsForPoseAndDriving) {
  publishes_poses_ = false;
  wait(5.0);
  EXPECT_EQ(now(), Phase::kWaiting);
  publishes_poses_ = true;
  publishes_driving_ = false;
  utime_ += 5 * 1'000'000;  // DRIVING_STATE times out
  wait(5.0);
  EXPECT_EQ(now(), Phase::kWaiting);
  publishes_driving_ = true;
  wait(0.2);
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionTest, EndsAtHomeAndReportsWhetherTheMineIsComplete) {
  to_explore();
  ExplorationReport report;
  report.request = request_.id;
  report.decision.kind = Kind::kDone;
  report.decision.complete = true;
  mission_.add_exploration(report);
  EXPECT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_TRUE(phase().complete);
  const int requests = explores_;
  wait(10.0);
  EXPECT_EQ(explores_, requests);
}

TEST_F(MissionTest, ScansWithTheLaserThatFacesTheRoute) {
  to_explore();
  reach_m_ = -10.0;
  answer(Kind::kHome);
  EXPECT_EQ(scan_.laser, LaserId::kRear);
  EXPECT_TRUE(phase().returning_home);
}

TEST_F(MissionTest, ScansStraightAheadWithoutAMap) {
  to_explore();
  ExplorationReport report;
  report.request = request_.id;
  mission_.add_exploration(report);  // kStay, revision 0
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  EXPECT_EQ(goal_.route_odom.back(), Eigen::Vector2d(10.0, 0.0));
  EXPECT_FALSE(phase().frontier);
}

TEST_F(MissionTest, RepeatsEachRequestUntilItIsAnswered) {
  to_explore();
  const auto [explores, id] = std::pair(explores_, request_.id);
  wait(4.5);  // two requests were lost
  EXPECT_EQ(explores_, explores + 2);
  EXPECT_EQ(request_.id, id);  // the same request
  to_scan();
  const int scans = scans_;
  wait(4.5);
  EXPECT_EQ(scans_, scans + 2);
  to_plan();
  const int goals = goals_;
  wait(4.5);
  EXPECT_EQ(goals_, goals + 2);
  to_execute();
  EXPECT_EQ(now(), Phase::kExecute);
}

TEST_F(MissionTest, IgnoresAnswersToOtherRequests) {
  to_explore();
  --request_.id;
  answer(Kind::kGoTo);
  EXPECT_EQ(now(), Phase::kExplore);
  ++request_.id;
  to_scan();
  mission_.add_terrain(utime_, phase().goal_id - 1);
  EXPECT_EQ(now(), Phase::kScan);
  to_plan();
  PlannedPath old;
  old.id = phase().goal_id;
  old.outcome = PlanOutcome::kFound;
  old.utime = terrain_utime_ - 1;  // rests on the previous scan
  mission_.add_path(old);
  EXPECT_EQ(now(), Phase::kPlan);
  old.utime = terrain_utime_;
  old.id = phase().goal_id - 1;
  mission_.add_path(old);
  EXPECT_EQ(now(), Phase::kPlan);
}

TEST_F(MissionTest, RescansAlsoWithTheOtherLaserIfNoScanArrives) {
  to_scan();
  const int id = phase().goal_id;
  wait(30.5);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_EQ(phase().goal_id, id + 1);
  EXPECT_EQ(scan_.laser, LaserId::kFront);
  wait(30.5);
  EXPECT_EQ(scan_.laser, LaserId::kRear);
}

TEST_F(MissionTest, IsStrandedIfNoScanArrives) {
  to_scan();
  wait(29.0);
  EXPECT_EQ(now(), Phase::kScan);
  wait(10.5 * 30.5);
  EXPECT_EQ(phase().outcome, MissionOutcome::kStranded);
  EXPECT_EQ(phase().reason, "no 3D scan arrives");
}

TEST_F(MissionTest, RescansIfPlanningDoesNotAnswer) {
  to_plan();
  wait(10.5);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_THAT(phase().reason, HasSubstr("planning did not answer"));
}

TEST_F(MissionTest, ExploresAgainIfDrivingLostItsPath) {
  to_execute();
  driving_.path_id = phase().goal_id - 1;
  wait(1.5);
  EXPECT_EQ(now(), Phase::kExecute);  // the path may not have arrived yet
  wait(1.0);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_THAT(phase().reason, HasSubstr("lost its path"));
}

}  // namespace
}  // namespace adit
