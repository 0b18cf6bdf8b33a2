// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What a mission does when planning finds no path or a drive fails.
#include <cmath>

#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Driving = DrivingState::Kind;

class MissionRecovery : public ScriptedStages {
 protected:
  void back() {
    driving(Driving::kDriving);
    x_m_ -= 0.25;
    tick();
  }
  /// 10 m of traversed path, so that it can back off.
  void drive_in() {
    to_execute();
    drive(10.0);
    arrive();
    answer(Kind::kAlong, 3);
    terrain();
    ASSERT_EQ(now(), Phase::kPlan);
  }
  /// Scan matching restarts during the drive; the new odom frame is the same place.
  void drive_into_another_odom() {
    match(kStart);
    map(kStart);
    to_execute();
    drive(5.0);
    match(utime_);
    ASSERT_EQ(now(), Phase::kWaiting);
  }
  /// 10 m into the mine, then home along the traversed path.
  void turn_home(double reach_m = -10.0) {
    drive_in();
    path(PlanOutcome::kFound);
    arrive();
    reach_m_ = reach_m;
    answer(Kind::kHome);
    terrain();
  }
  void reject_home(PlanOutcome outcome = PlanOutcome::kBlocked) {
    answer(Kind::kHome);
    terrain();
    path(outcome);
  }
  /// The path to the target is rejected for unobserved ground; backs off to see beside the vehicle.
  void scan_beside(double reached_m, PlanOutcome rejected = PlanOutcome::kUnknown) {
    path(rejected, reached_m);
    ASSERT_EQ(now(), Phase::kPlan);
    EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
    EXPECT_NEAR(goal_.distance_m, 1.2, 1e-9);
    scan_from_back(1.25);
    ASSERT_EQ(now(), Phase::kPlan);
  }
  void drive_back(double path_length_m) {
    path(PlanOutcome::kFound);
    for (int i = 0; i < std::lround(path_length_m / 0.25); ++i) back();
    arrive();
  }
  /// Drives back that far, then plans to the same target.
  void scan_from_back(double path_length_m) {
    drive_back(path_length_m);
    answer(Kind::kAlong, 3);
    terrain();
  }
};

TEST_F(MissionRecovery, ScansBesideThenWithTheOtherLaserThenFromFartherBackThenReports) {
  drive_in();
  scan_beside(0.95);
  path(PlanOutcome::kUnknown, 0.7);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_EQ(scan_.laser, LaserId::kRear);
  terrain();
  path(PlanOutcome::kUnknown, 0.7);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 3.0, 0.26);  // a step of driving
  path(PlanOutcome::kFound);
  ASSERT_EQ(now(), Phase::kExecute);
  arrive();
  ASSERT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kUnknown, 0.9);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 6.0, 0.26);  // again, and farther
  path(PlanOutcome::kFound);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kUnknown, 0.9);
  ASSERT_EQ(now(), Phase::kExplore);
  ASSERT_TRUE(request_.blocked);
  EXPECT_EQ(request_.blocked->frontier, 3);
  EXPECT_EQ(request_.blocked->reached_m, 0.95);
  EXPECT_THAT(request_.blocked->evidence, HasSubstr("a beam blocks the path Again: a beam"));
  EXPECT_TRUE(request_.blocked->unconfirmed);  // no scan observed an obstacle
}

/// Ground in shadow is observed from nearer.
TEST_F(MissionRecovery, ApproachesUnobservedGround) {
  drive_in();
  scan_beside(1.0);
  path(PlanOutcome::kUnknown, 2.0);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("driving nearer"));
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRouteTo);  // any heading
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + 1.0, 1e-9);
  path(PlanOutcome::kFound);
  drive(3.0);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + reach_m_, 1e-9);  // as far as possible
  scan_beside(1.0);                                                 // another place
  path(PlanOutcome::kUnknown, 1.4);
  EXPECT_THAT(phase().reason, HasSubstr("driving nearer"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + 0.4, 1e-9);
}

TEST_F(MissionRecovery, ScansWithTheOtherLaserIfItCannotApproach) {
  drive_in();
  scan_beside(1.0);
  path(PlanOutcome::kUnknown, 2.0);
  path(PlanOutcome::kUnknown, 1.2);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_EQ(scan_.laser, LaserId::kRear);
  terrain();
  path(PlanOutcome::kUnknown, 2.0);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));  // one approach per target
}

TEST_F(MissionRecovery, DoesNotApproachObservedObstacles) {
  drive_in();
  path(PlanOutcome::kBlocked, 2.0);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
}

TEST_F(MissionRecovery, RecoversIfSixPathsEndAtTheSamePlace) {
  drive_in();
  for (int i = 0; i < 5; ++i) {  // six with the one that led here
    path(PlanOutcome::kFound);
    ASSERT_EQ(now(), Phase::kExecute);
    arrive();
    if (i < 4) {
      EXPECT_THAT(phase().reason, HasSubstr("the end of the path"));
      answer(Kind::kAlong, 3);
      terrain();
    }
  }
  EXPECT_THAT(phase().reason, HasSubstr("The last paths all ended at the same place"));
}

TEST_F(MissionRecovery, ReportsBlockedAfterObservationsFromTwoPoses) {
  drive_in();
  path(PlanOutcome::kBlocked);
  scan_from_back(3.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_FALSE(request_.blocked->unconfirmed);
  EXPECT_THAT(phase().reason, HasSubstr("the path is blocked"));
}

/// There terrain of earlier scans may stand up as an obstacle.
TEST_F(MissionRecovery, ReportsUnconfirmedFromASteepSlope) {
  drive_in();
  path(PlanOutcome::kBlocked);
  scan_from_back(3.0);
  ScanMatch match;
  match.attitude = Attitude{0.0, -std::atan(0.25)};
  mission_.add_match(match);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);
}

/// Two scans may miss by a cell what a third one shows.
TEST_F(MissionRecovery, ReportsUnconfirmedIfOneScanShowsANarrowPassage) {
  drive_in();
  path(PlanOutcome::kBlocked);
  scan_from_back(3.0);
  scan_beside(0.5, PlanOutcome::kNarrow);
  path(PlanOutcome::kBlocked);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));  // two scans observed it
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);

  // The same when that frontier is tried again after another one.
  answer(Kind::kAlong, 4);
  terrain();
  scan_from_back(0.0);
  for (int i = 0; i < 2; ++i) {
    path(PlanOutcome::kBlocked);
    EXPECT_THAT(phase().reason, HasSubstr("backing off"));
    scan_from_back(0.0);
  }
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);
}

/// A scan from nearer resolves what one from afar could not.
TEST_F(MissionRecovery, ReportsBlockedIfScansFromNearerShowThatAPassageIsTooNarrow) {
  drive_in();
  scan_beside(2.4, PlanOutcome::kNarrow);
  path(PlanOutcome::kFound);
  drive(3.25);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kBlocked, 0.3);
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked, 0.3);
  ASSERT_TRUE(request_.blocked);
  EXPECT_FALSE(request_.blocked->unconfirmed);
}

/// The same frontier may be farther along the tunnel.
TEST_F(MissionRecovery, ReportsBlockedBehindANarrowPassageThatItDroveThrough) {
  drive_in();
  scan_beside(0.5, PlanOutcome::kNarrow);
  path(PlanOutcome::kFound);
  drive(8.0);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kBlocked);
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_FALSE(request_.blocked->unconfirmed);
}

TEST_F(MissionRecovery, BacksOffImmediatelyFromObservedObstacles) {
  drive_in();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
}

TEST_F(MissionRecovery, BacksOffIntoTheEarlierOdomFrameOnceTheMapCorrectionIsKnown) {
  drive_into_another_odom();
  map(utime_);
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 3.0, 0.26);  // a step of driving
}

/// The map correction is uncertain until the robot has moved.
TEST_F(MissionRecovery, BacksOffIntoTheEarlierOdomFrameAfterASecondRejection) {
  drive_into_another_odom();
  map(utime_, Eigen::Vector3d(0.5, 0.5, 0.01).asDiagonal().toDenseMatrix());
  to_plan();
  path(PlanOutcome::kUnknown);
  ASSERT_EQ(now(), Phase::kScan);
  EXPECT_THAT(phase().reason, HasSubstr("with the other laser"));
  terrain();
  path(PlanOutcome::kUnknown);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 1.2, 0.26);  // a step of driving
}

TEST_F(MissionRecovery, ScansTwiceIfItCannotBackOff) {
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
  answer(Kind::kGoTo);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_TRUE(request_.blocked);
}

TEST_F(MissionRecovery, CannotBackOffWhereItOnlyTurned) {
  to_explore();
  for (int i = 0; i < 20; ++i) {
    heading_ += 0.12;
    tick();
  }
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionRecovery, KeepsTheRouteIfPlanningTimesOutOnTheReturn) {
  drive_in();
  const auto route = goal_.route_odom;
  path(PlanOutcome::kBlocked);
  ASSERT_NE(goal_.route_odom, route);
  wait(10.5);
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  EXPECT_EQ(goal_.route_odom, route);
}

TEST_F(MissionRecovery, RepeatsAVerdictUntilItIsAnsweredAndTellsItOnce) {
  to_plan();
  path(PlanOutcome::kBlocked);
  answer(Kind::kGoTo);
  terrain();
  path(PlanOutcome::kBlocked);
  const int id = request_.id;
  request_ = {};
  wait(2.5);
  EXPECT_EQ(request_.id, id);
  EXPECT_TRUE(request_.blocked);
  answer(Kind::kGoTo, 1);
  to_execute();
  drive(2.0);
  arrive();
  EXPECT_FALSE(request_.blocked);
}

TEST_F(MissionRecovery, ResetsForAnotherTarget) {
  to_plan();
  path(PlanOutcome::kBlocked);
  answer(Kind::kGoTo, 1);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_FALSE(request_.blocked);
}

TEST_F(MissionRecovery, ReportsUnconfirmedWithoutBlockingCells) {
  blocks_ = false;
  to_plan();
  path(PlanOutcome::kBlocked);
  for (int i = 0; i < 9 && !request_.blocked; ++i) {
    if (now() == Phase::kExplore) answer(Kind::kGoTo);
    if (now() == Phase::kScan) terrain();
    path(PlanOutcome::kBlocked);
  }
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);
}

/// A failed drive is no evidence about the ground: a path existed.
TEST_F(MissionRecovery, RescansAfterAFailedDrive) {
  drive_in();
  path(PlanOutcome::kFound);
  driving(Driving::kFailed, "beside its path");
  tick();
  ASSERT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kFound);
  driving(Driving::kFailed, "held by a stop order");
  tick();
  EXPECT_EQ(now(), Phase::kPlan);                   // backs off
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);  // over the traversed path
}

/// Jumping poses fail every drive, also those back.
TEST_F(MissionRecovery, ReportsUnconfirmedAfterFailedDrives) {
  drive_in();
  for (int i = 0; i < 20 && !request_.blocked; ++i) {
    path(PlanOutcome::kFound);
    driving(Driving::kFailed, "beside its path");
    tick();
    if (now() != Phase::kExplore || request_.blocked) continue;
    answer(Kind::kAlong, 3);
    terrain();
  }
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);
  EXPECT_THAT(request_.blocked->evidence, HasSubstr("Driving failed: beside its path."));
}

TEST_F(MissionRecovery, ScansWhereADriveBackFailed) {
  drive_in();
  path(PlanOutcome::kBlocked);
  path(PlanOutcome::kFound);
  for (int i = 0; i < 6; ++i) back();
  driving(Driving::kFailed, "beside its path");
  tick();
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
}

TEST_F(MissionRecovery, ForgetsRejectionsAfterProgress) {
  drive_in();
  path(PlanOutcome::kBlocked);
  path(PlanOutcome::kFound);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kFound);
  drive(2.0);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kPlan);  // may back off again
}

TEST_F(MissionRecovery, TimesOutIfDrivingIsStale) {
  to_execute();
  publishes_driving_ = false;
  wait(3.5);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_THAT(phase().reason, HasSubstr("Driving timed out."));
}

/// The next plan does not inherit the back-off.
TEST_F(MissionRecovery, ForgetsTheBackOffIfDrivingTimesOut) {
  drive_in();
  path(PlanOutcome::kBlocked);
  path(PlanOutcome::kFound);
  publishes_driving_ = false;
  wait(3.5);
  ASSERT_EQ(now(), Phase::kExplore);
  publishes_driving_ = true;
  wait(2.0);
  answer(Kind::kAlong, 4);
  const std::int64_t old_utime = terrain_utime_;
  terrain();
  PlannedPath old;
  old.id = phase().goal_id;
  old.utime = old_utime;
  old.outcome = PlanOutcome::kFound;
  mission_.add_path(old);
  EXPECT_EQ(now(), Phase::kPlan);
}

/// Backing off would lead into the mine again.
TEST_F(MissionRecovery, RejoinsTheTraversedPathOnTheReturn) {
  turn_home(-5.0);  // too short to drive without a scan
  path(PlanOutcome::kBlocked);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
  EXPECT_EQ(goal_.traversed_path_odom.front(), (Pose2{x_m_, 0.0, 0.0}));
  EXPECT_NEAR(goal_.traversed_path_odom.back().x, 0.0, 1e-9);  // all poses nearby
  const double first_m = goal_.distance_m;
  for (int again = 0; again < 2; ++again) {
    drive_back(1.5);
    EXPECT_FALSE(request_.blocked);
    reject_home();
    ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
    EXPECT_EQ(goal_.distance_m, first_m);
  }
}

TEST_F(MissionRecovery, RejoinsFartherAfterRejoinsWithoutProgress) {
  turn_home(-5.0);  // too short to drive without a scan
  path(PlanOutcome::kUnknown);
  const double first_m = goal_.distance_m;
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRejoin) << again;
    drive_back(0.25);
    reject_home(PlanOutcome::kUnknown);
  }
  EXPECT_GT(goal_.distance_m, first_m);
}

/// Otherwise the drive along the traversed path leads away from it, and exploration back to it.
TEST_F(MissionRecovery, AbandonsARejectedShortCutHome) {
  turn_home();
  reach_m_ = 10.0;  // not on the traversed path
  drive_back(1.0);
  reject_home();
  ASSERT_EQ(now(), Phase::kExplore);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);  // no second scan
  detour_length_m_ = 20.0;                     // exploration chooses another path
  reject_home();
  EXPECT_TRUE(request_.blocked);
}

TEST_F(MissionRecovery, ScansWithTheOtherLaserBeforeItAbandonsAnUnobservedShortCut) {
  turn_home();
  reach_m_ = 10.0;
  drive_back(1.0);
  reject_home(PlanOutcome::kUnknown);
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  path(PlanOutcome::kUnknown);
  EXPECT_TRUE(request_.blocked);
}

/// The longer path after a rejoin does not count as another path.
TEST_F(MissionRecovery, RejoinsIfExplorationHasNoOtherPathThanTheShortCut) {
  turn_home();
  reach_m_ = 10.0;
  drive_back(1.0);
  reject_home();
  ASSERT_TRUE(request_.blocked);
  double before_m = 0.0;
  for (const double detour_m : {0.0, 6.0, 12.0}) {
    detour_length_m_ = detour_m;
    reject_home(PlanOutcome::kUnknown);
    ASSERT_EQ(now(), Phase::kPlan);
    EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
    EXPECT_GE(goal_.distance_m, before_m);
    before_m = goal_.distance_m;
    drive_back(0.25);
  }
  EXPECT_GT(before_m, 6.0);
}

TEST_F(MissionRecovery, RejoinsIfTheRouteFollowsTheTraversedPath) {
  drive_in();
  path(PlanOutcome::kFound);
  arrive();
  reach_m_ = -5.0;
  answer(Kind::kGoTo, 4);
  terrain();
  path(PlanOutcome::kUnknown);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
  EXPECT_NEAR(goal_.distance_m, 5.0, 1e-9);  // as far as the route follows it
}

/// The same obstacle may stop it again.
TEST_F(MissionRecovery, PlansAPathAfterAFailedDriveOnTheTraversedPath) {
  turn_home();
  path(PlanOutcome::kUnknown);
  path(PlanOutcome::kFound);
  driving(Driving::kFailed, "held by a stop order");
  tick();
  ASSERT_EQ(now(), Phase::kExplore);
  reject_home(PlanOutcome::kUnknown);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);  // over observed terrain
}

/// It may have failed because scan matching slipped, and its ground may be hidden from scans.
TEST_F(MissionRecovery, DrivesOnTheTraversedPathAgainIfNoPlannedPathIsFound) {
  turn_home();
  ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  path(PlanOutcome::kFound);
  driving(Driving::kFailed, "wheel odometry and scans differ");
  tick();
  int planned = 0;
  for (; planned < 10 && now() == Phase::kExplore; ++planned) {
    answer(Kind::kHome);
    if (now() == Phase::kPlan) break;  // without a scan
    while (now() == Phase::kScan || now() == Phase::kPlan) {
      if (now() == Phase::kScan) terrain();
      path(PlanOutcome::kUnknown);
    }
  }
  EXPECT_GT(planned, 0);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
}

TEST_F(MissionRecovery, BacksOffByAPlannedPathIfRetracingIsRejected) {
  drive_in();
  path(PlanOutcome::kBlocked);
  ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionRecovery, ReturnsOnTheTraversedPathIfExplorationFindsNoRoute) {
  drive_in();
  path(PlanOutcome::kFound);
  arrive();
  map(utime_);
  order(MissionOrder::Kind::kReturnHome);
  for (int i = 0; i < 32 && now() == Phase::kExplore; ++i) {
    ExplorationReport stay;
    stay.request = request_.id;
    stay.revision = 1;
    mission_.add_exploration(stay);
    wait(1.0);
  }
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
}

/// There is no route along which to scan.
TEST_F(MissionRecovery, ExploresAgainIfPlanningDoesNotAnswerARejoinWithoutATarget) {
  match(kStart);
  for (int i = 0; i < 40; ++i) {
    x_m_ += 0.25;
    tick();
  }
  map(utime_);
  order(MissionOrder::Kind::kReturnHome);
  for (int i = 0; i < 32 && now() == Phase::kExplore; ++i) {
    ExplorationReport stay;
    stay.request = request_.id;
    stay.revision = 1;
    mission_.add_exploration(stay);
    wait(1.0);
  }
  ASSERT_EQ(now(), Phase::kPlan);
  wait(10.5);
  EXPECT_EQ(now(), Phase::kExplore);
}

/// The robot has come back to x = 6 m from 10 m, and the traversed path leads home.
TEST_F(MissionRecovery, GoesBackIntoTheMineToApproachAgainWhereItIsStuck) {
  match(kStart);
  while (x_m_ < 10.0) {
    x_m_ += 0.25;
    tick();
  }
  while (x_m_ > 6.0) {
    x_m_ -= 0.25;
    tick();
  }
  map(utime_);
  order(MissionOrder::Kind::kReturnHome);
  const auto goes_back_in = [&] {
    return now() == Phase::kPlan && goal_.kind == PlanGoal::Kind::kRetrace &&
           goal_.T_odom_goal.x > x_m_ + 1.0;
  };
  for (int i = 0; i < 100 && now() != Phase::kEnded && !goes_back_in(); ++i) {
    answer(Kind::kHome);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  ASSERT_TRUE(goes_back_in());
  path(PlanOutcome::kFound);
  arrive();
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionRecovery, IsStrandedAfterTooManyAttemptsOnTheReturn) {
  to_explore();
  for (int i = 0; i < 100 && now() != Phase::kEnded; ++i) {
    answer(Kind::kHome);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  EXPECT_EQ(phase().outcome, MissionOutcome::kStranded);
  EXPECT_THAT(phase().reason, HasSubstr("no path onward was found"));
}

/// Each back-off leads 3 m away and the next drive back to the same place.
TEST_F(MissionRecovery, DoesNotCountBackingOffAsProgress) {
  drive_in();
  path(PlanOutcome::kBlocked);
  path(PlanOutcome::kFound);
  drive(2.0);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_TRUE(request_.blocked);
}

/// Paths found from farther back lead to the place of the rejection again and again.
TEST_F(MissionRecovery, DoesNotDriveBackAndForthForever) {
  drive_in();
  for (int i = 0; i < 10 && !request_.blocked; ++i) {
    path(PlanOutcome::kBlocked);
    if (request_.blocked) break;
    path(PlanOutcome::kFound);
    for (int k = 0; k < 12; ++k) back();
    arrive();
    answer(Kind::kAlong, 3);
    terrain();
    path(PlanOutcome::kFound);
    drive(3.0);
    arrive();
    answer(Kind::kAlong, 3);
    terrain();
    ASSERT_LT(i, 3);
  }
  EXPECT_TRUE(request_.blocked);
}

TEST_F(MissionRecovery, ReportsNothingBlockedWithoutATargetOfExploration) {
  to_explore();
  ExplorationReport nothing;
  nothing.request = request_.id;
  for (int i = 0; i < 10; ++i) {
    nothing.request = request_.id;
    if (now() == Phase::kExplore) mission_.add_exploration(nothing);
    ASSERT_EQ(now(), Phase::kScan);
    terrain();
    path(PlanOutcome::kBlocked);
    EXPECT_FALSE(request_.blocked);
  }
}

TEST_F(MissionRecovery, TimesOutIfExplorationDoesNotAnswer) {
  to_explore();
  wait(299.0);
  EXPECT_EQ(now(), Phase::kExplore);
  wait(2.0);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionRecovery, RepeatsAnIncompleteScan) {
  to_scan();
  const int incomplete = phase().goal_id;
  mission_.add_cloud(incomplete, false);
  advance();
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_NE(phase().goal_id, incomplete);
  mission_.add_terrain(utime_, incomplete);
  EXPECT_EQ(now(), Phase::kScan);
  for (int i = 0; i < 3; ++i) mission_.add_cloud(phase().goal_id, false);
  terrain();
  EXPECT_EQ(now(), Phase::kPlan);
}

TEST_F(MissionRecovery, EndsAtHomeIfNoPathLeadsIntoTheMine) {
  to_explore();
  for (int i = 0; i < 100 && now() != Phase::kEnded; ++i) {
    ExplorationReport nothing;
    nothing.request = request_.id;
    mission_.add_exploration(nothing);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_THAT(phase().reason, HasSubstr("no path into the mine"));
}

TEST_F(MissionRecovery, ScansStraightAheadIfExplorationOnlyStays) {
  to_explore();
  const auto stay = [&] {
    ExplorationReport report;
    report.request = request_.id;
    report.revision = 1;
    mission_.add_exploration(report);
    advance();
  };
  stay();
  EXPECT_EQ(now(), Phase::kExplore);
  for (int i = 0; i < 31; ++i) {
    wait(1.0);
    stay();
  }
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_THAT(phase().reason, HasSubstr("exploration found no route"));
}

}  // namespace
}  // namespace adit
