// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What a mission does where there is no way on.
#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Driving = DrivingState::Kind;

class MissionNoPath : public ScriptedStages {
 protected:
  void back() {
    driving(Driving::kDriving);
    x_m_ -= 0.25;
    tick();
  }
  /// A way behind it, so that it can back off.
  void drive_in() {
    to_execute();
    drive(10.0);
    arrive();
    answer(Kind::kAlong, 3);
    terrain();
    ASSERT_EQ(now(), Phase::kPlan);
  }
  /// Scan matching is started again on the way; odom is where it was.
  void drive_into_another_odom() {
    match(kStart);
    map(kStart);
    to_execute();
    drive(5.0);
    match(utime_);
    ASSERT_EQ(now(), Phase::kWaiting);
  }
  /// From 10 m in, back along its track, as exploration leads.
  void turn_home() {
    drive_in();
    path(PlanOutcome::kFound);
    arrive();
    reach_m_ = -10.0;
    answer(Kind::kHome);
    terrain();
  }
  void reject_home(PlanOutcome outcome = PlanOutcome::kBlocked) {
    answer(Kind::kHome);
    terrain();
    path(outcome);
  }
  /// To where that leads, as a path to its target is refused for what it does not see.
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
  /// So far along its track, and at the same target from there.
  void scan_from_back(double path_length_m) {
    drive_back(path_length_m);
    answer(Kind::kAlong, 3);
    terrain();
  }
};

TEST_F(MissionNoPath, LooksBesideAndToTheOtherSideThenFromFartherBackThenSaysSo) {
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
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 6.0, 0.26);  // once more, and farther
  path(PlanOutcome::kFound);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  path(PlanOutcome::kUnknown, 0.9);
  ASSERT_EQ(now(), Phase::kExplore);
  ASSERT_TRUE(request_.blocked);
  EXPECT_EQ(request_.blocked->frontier, 3);
  EXPECT_EQ(request_.blocked->reached_m, 0.95);
  EXPECT_THAT(request_.blocked->evidence, HasSubstr("a beam is in the way Again: a beam"));
  EXPECT_TRUE(request_.blocked->unconfirmed);  // no look has seen that there is no way
}

/// What lies in shadow from here may be seen from there.
TEST_F(MissionNoPath, GoesNearerToWhatItDoesNotSee) {
  drive_in();
  scan_beside(1.0);
  path(PlanOutcome::kUnknown, 2.0);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("driving nearer"));
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRouteTo);  // with any heading
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + 1.7, 1e-9);
  path(PlanOutcome::kFound);
  drive(3.0);
  arrive();
  answer(Kind::kAlong, 3);
  terrain();
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + reach_m_, 1e-9);  // as far as possible
  scan_beside(1.0);                                                 // it is another place
  path(PlanOutcome::kUnknown, 1.2);
  EXPECT_THAT(phase().reason, HasSubstr("driving nearer"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ + 0.9, 1e-9);
}

TEST_F(MissionNoPath, LooksToTheOtherSideWhereItGetsNoNearer) {
  drive_in();
  scan_beside(1.0);
  path(PlanOutcome::kUnknown, 2.0);
  path(PlanOutcome::kUnknown, 1.2);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_EQ(scan_.laser, LaserId::kRear);
  terrain();
  path(PlanOutcome::kUnknown, 2.0);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));  // once from a place
}

TEST_F(MissionNoPath, GoesNoNearerToWhatItSees) {
  drive_in();
  path(PlanOutcome::kBlocked, 2.0);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
}

TEST_F(MissionNoPath, RejectsPathAfterPathThatLeadsNowhere) {
  drive_in();
  for (int i = 0; i < 5; ++i) {  // with the one that led here, six
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

TEST_F(MissionNoPath, IsSureOfWhatItSawFromTwoPlaces) {
  drive_in();
  path(PlanOutcome::kBlocked);
  scan_from_back(3.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_FALSE(request_.blocked->unconfirmed);
  EXPECT_THAT(phase().reason, HasSubstr("the path is blocked"));
}

/// Two looks may miss by a cell what a third one sees.
TEST_F(MissionNoPath, IsNotSureWhereOneLookSaysThatItMayJustFit) {
  drive_in();
  path(PlanOutcome::kBlocked);
  scan_from_back(3.0);
  scan_beside(0.5, PlanOutcome::kNarrow);
  path(PlanOutcome::kBlocked);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));  // two saw it
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);

  // Nor when it is tried once more, after another.
  answer(Kind::kAlong, 4);
  terrain();
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked);
  scan_from_back(0.0);
  path(PlanOutcome::kBlocked);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);
}

TEST_F(MissionNoPath, BacksOffAtOnceFromWhatItSees) {
  drive_in();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
}

/// No look shows a path.
TEST_F(MissionNoPath, BacksOffIntoTheOdomFrameBeforeOnceItHasItsMap) {
  drive_into_another_odom();
  map(utime_);
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_THAT(phase().reason, HasSubstr("backing off"));
  EXPECT_NEAR(goal_.route_odom.back().x(), x_m_ - 3.0, 0.26);  // a step of driving
}

/// The map does not know well where it is until it has moved.
TEST_F(MissionNoPath, BacksOffIntoTheOdomFrameBeforeWhereNothingElseIsLeft) {
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

TEST_F(MissionNoPath, LooksTwiceWhereItCannotBackOff) {
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
  answer(Kind::kGoTo);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_TRUE(request_.blocked);
}

TEST_F(MissionNoPath, CannotBackOffWhereItOnlyTurned) {
  to_explore();
  for (int i = 0; i < 20; ++i) {
    heading_ += 0.12;
    tick();
  }
  to_plan();
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionNoPath, KeepsItsRouteWherePlanningFallsStaleOnTheWayBack) {
  drive_in();
  const auto route = goal_.route_odom;
  path(PlanOutcome::kBlocked);
  ASSERT_NE(goal_.route_odom, route);
  wait(10.5);
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  EXPECT_EQ(goal_.route_odom, route);
}

TEST_F(MissionNoPath, RepeatsAVerdictUntilItIsAnsweredAndTellsItOnce) {
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

TEST_F(MissionNoPath, BeginsResetForAnotherTarget) {
  to_plan();
  path(PlanOutcome::kBlocked);
  answer(Kind::kGoTo, 1);
  terrain();
  path(PlanOutcome::kBlocked);
  EXPECT_FALSE(request_.blocked);
}

TEST_F(MissionNoPath, IsNeverSureWhereNothingIsNamedThatIsInTheWay) {
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

/// It says nothing of the ground: there was a path.
TEST_F(MissionNoPath, LooksAgainWhereADriveFails) {
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
  EXPECT_EQ(now(), Phase::kPlan);                   // it backs off
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);  // on its own track
}

/// Poses that jump fail one drive after the other, those to get back, too.
TEST_F(MissionNoPath, IsNeverSureByDrivesThatFail) {
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

TEST_F(MissionNoPath, LooksFromWhereADriveBackFailed) {
  drive_in();
  path(PlanOutcome::kBlocked);
  path(PlanOutcome::kFound);
  for (int i = 0; i < 6; ++i) back();
  driving(Driving::kFailed, "beside its path");
  tick();
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_FALSE(request_.blocked);
}

TEST_F(MissionNoPath, ForgetsRejectionsOnceItGotOn) {
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
  EXPECT_EQ(now(), Phase::kPlan);  // it may back off once more
}

TEST_F(MissionNoPath, DoesNotWaitForDrivingForEver) {
  to_execute();
  publishes_driving_ = false;
  wait(3.5);
  EXPECT_EQ(now(), Phase::kExplore);
  EXPECT_THAT(phase().reason, HasSubstr("Driving timed out."));
}

/// Of a path that was to lead back, nothing is left for the next that is planned.
TEST_F(MissionNoPath, ForgetsThatItBackedOffWhereDrivingFallsStale) {
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

/// To back off would lead it into the mine again.
TEST_F(MissionNoPath, GoesOnAlongItsTraversedPathOnTheWayHome) {
  turn_home();
  path(PlanOutcome::kBlocked);
  ASSERT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
  EXPECT_EQ(goal_.traversed_path_odom.front(), (Pose2{x_m_, 0.0, 0.0}));
  EXPECT_NEAR(goal_.traversed_path_odom.back().x, 0.0, 1e-9);  // all that is near
  const double first_m = goal_.distance_m;
  for (int again = 0; again < 2; ++again) {
    drive_back(1.5);
    EXPECT_FALSE(request_.blocked);
    reject_home();
    ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
    EXPECT_EQ(goal_.distance_m, first_m);
  }
}

TEST_F(MissionNoPath, GoesTheFartherAlongItsTrackTheLessThatHelps) {
  turn_home();
  path(PlanOutcome::kUnknown);
  const double first_m = goal_.distance_m;
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRejoin) << again;
    drive_back(0.25);
    reject_home(PlanOutcome::kUnknown);
  }
  EXPECT_GT(goal_.distance_m, first_m);
}

/// The drive along the track leads away from it, and exploration back to it, again and again.
TEST_F(MissionNoPath, ClosesAShortCutHomeThatIsRejected) {
  turn_home();
  reach_m_ = 10.0;  // where it never was
  drive_back(1.0);
  reject_home();
  ASSERT_EQ(now(), Phase::kExplore);
  ASSERT_TRUE(request_.blocked);
  EXPECT_TRUE(request_.blocked->unconfirmed);  // it is not worth a second look
  detour_length_m_ = 20.0;                     // and exploration leads another way
  reject_home();
  EXPECT_TRUE(request_.blocked);
}

TEST_F(MissionNoPath, LooksToTheOtherSideBeforeItClosesAShortCutThatItDoesNotSee) {
  turn_home();
  reach_m_ = 10.0;
  drive_back(1.0);
  reject_home(PlanOutcome::kUnknown);
  ASSERT_EQ(now(), Phase::kScan);
  terrain();
  path(PlanOutcome::kUnknown);
  EXPECT_TRUE(request_.blocked);
}

/// Then the drive along the track, which leads away from it, makes no other way of it.
TEST_F(MissionNoPath, GoesAlongItsTraversedPathWhereExplorationKnowsNoOtherWayThanTheShortCut) {
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

TEST_F(MissionNoPath, GoesAlongItsTraversedPathWhereTheRouteDoes) {
  drive_in();
  path(PlanOutcome::kFound);
  arrive();
  reach_m_ = -5.0;
  answer(Kind::kGoTo, 4);
  terrain();
  path(PlanOutcome::kUnknown);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRejoin);
  EXPECT_NEAR(goal_.distance_m, 5.0, 1e-9);  // as far as the route keeps to it
}

/// What holds it there may hold it again.
TEST_F(MissionNoPath, LooksForAWayWhereADriveOnItsTraversedPathFailed) {
  turn_home();
  path(PlanOutcome::kUnknown);
  path(PlanOutcome::kFound);
  driving(Driving::kFailed, "held by a stop order");
  tick();
  ASSERT_EQ(now(), Phase::kExplore);
  reject_home(PlanOutcome::kUnknown);
  EXPECT_EQ(now(), Phase::kPlan);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);  // it backs off by what it sees
}

TEST_F(MissionNoPath, BacksOffByWhatItSeesWithoutATrack) {
  drive_in();
  path(PlanOutcome::kBlocked);
  ASSERT_EQ(goal_.kind, PlanGoal::Kind::kRetrace);
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(goal_.kind, PlanGoal::Kind::kRoute);
  path(PlanOutcome::kBlocked);
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionNoPath, ComesHomeOnItsTraversedPathWhereExplorationKnowsNoWay) {
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

TEST_F(MissionNoPath, IsStrandedAfterSoManyTriesOnTheWayHome) {
  to_explore();
  for (int i = 0; i < 100 && now() != Phase::kEnded; ++i) {
    answer(Kind::kHome);
    terrain();
    path(PlanOutcome::kBlocked);
  }
  EXPECT_EQ(phase().outcome, MissionOutcome::kStranded);
  EXPECT_THAT(phase().reason, HasSubstr("no path onward was found"));
}

/// Each time to 3 m from there and back again to where it ends.
TEST_F(MissionNoPath, DoesNotTakeBackingOffForGettingOn) {
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

/// What is seen from farther back leads to where it was refused, again and again.
TEST_F(MissionNoPath, DoesNotPaceBackAndForthForEver) {
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

TEST_F(MissionNoPath, CallsNothingBlockedThatExplorationDidNotName) {
  to_explore();
  ExplorationReport nothing;
  nothing.request = request_.id;
  for (int look = 0; look < 10; ++look) {
    nothing.request = request_.id;
    if (now() == Phase::kExplore) mission_.add_exploration(nothing);
    ASSERT_EQ(now(), Phase::kScan);
    terrain();
    path(PlanOutcome::kBlocked);
    EXPECT_FALSE(request_.blocked);
  }
}

TEST_F(MissionNoPath, DoesNotWaitForExplorationForEver) {
  to_explore();
  wait(299.0);
  EXPECT_EQ(now(), Phase::kExplore);
  wait(2.0);
  EXPECT_EQ(now(), Phase::kScan);
}

TEST_F(MissionNoPath, JudgesByNoScanThatWasCutShort) {
  to_scan();
  const int cut = phase().goal_id;
  mission_.add_cloud(cut, false);
  advance();
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_NE(phase().goal_id, cut);
  mission_.add_terrain(utime_, cut);
  EXPECT_EQ(now(), Phase::kScan);
  for (int i = 0; i < 3; ++i) mission_.add_cloud(phase().goal_id, false);
  terrain();
  EXPECT_EQ(now(), Phase::kPlan);
}

TEST_F(MissionNoPath, IsAtHomeWhereNothingLeadsIntoTheMine) {
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

TEST_F(MissionNoPath, GoesBySightWhereExplorationOnlyStays) {
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
