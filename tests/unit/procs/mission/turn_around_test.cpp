// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Turning around at limits, orders, and resets of odom.
#include <gmock/gmock.h>

#include "tests/unit/procs/mission/scripted_stages.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using Order = MissionOrder::Kind;

class MissionTurnaround : public ScriptedStages {
 protected:
  void expect_homeward(const std::string& reason) {
    tick();
    EXPECT_EQ(now(), Phase::kExplore);
    EXPECT_TRUE(phase().returning_home);
    EXPECT_THAT(phase().return_home_reason, HasSubstr(reason));
    EXPECT_TRUE(request_.returning_home);
    const int sequence = phase().sequence;
    tick();
    EXPECT_EQ(phase().sequence, sequence);  // once
  }
};

TEST_F(MissionTurnaround, TurnsAroundInBadAir) {
  to_execute();
  mission_.limits().add(GasReading{utime_, 0.02, 0.209, 0.0});
  expect_homeward("2.00 % of methane");
}

TEST_F(MissionTurnaround, TurnsAroundAtLowOxygen) {
  to_scan();
  mission_.limits().add(GasReading{utime_, 0.0, 0.17, 0.0});
  expect_homeward("only 17.0 % of oxygen");
}

TEST_F(MissionTurnaround, TurnsAroundOnSoftGround) {
  to_plan();
  mission_.limits().add(SinkageReading{utime_, {0.0, 0.0, 0.12, 0.0}});
  expect_homeward("a wheel is 0.12 m deep");
}

TEST_F(MissionTurnaround, TurnsAroundIfTheMapIsUncertain) {
  to_execute();
  MapCorrection correction;
  correction.covariance = Eigen::Vector3d(36.0, 1.0, 0.1).asDiagonal().toDenseMatrix();
  mission_.add_correction(correction);
  expect_homeward("of the map is 6.0 m");
}

/// At first the rear laser, which observes all directions, alternates with the front laser.
TEST_F(MissionTurnaround, TurnsAroundIfNoSensorMeasuresMotion) {
  ScanMatch measured;
  measured.status = ScanMatch::Status::kMatched;
  ScanMatch open = measured;
  open.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kNone}};
  to_execute();
  const auto add = [&](const ScanMatch& match) {
    tick();
    mission_.add_match(match);
  };
  for (int i = 0; i < 300; ++i) {
    open.utime = measured.utime = utime_;
    add(i % 2 == 0 ? open : measured);
  }
  EXPECT_FALSE(phase().returning_home);
  const std::int64_t since_utime = utime_;
  while (!phase().returning_home && utime_ < since_utime + 20'000'000) {
    open.utime = utime_;
    add(open);
  }
  EXPECT_NEAR(1e-6 * static_cast<double>(utime_ - since_utime), 10.0, 0.35);  // ticks of 0.1 s
  expect_homeward("no sensor measured the motion");
  // A drive that fails for that reason on the return is the last one.
  to_execute();
  driving(DrivingState::Kind::kFailed, "no sensor measured the motion for 5.0 m");
  tick();
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kStranded);
  EXPECT_THAT(phase().reason, HasSubstr("the pose of the robot is unknown"));
}

/// Motion is not observed from the start on, while the wheels roll at 0.2 m/s for `seconds`.
class UnmeasuredMission : public MissionTurnaround {
 protected:
  void roll_unmeasured(double seconds) {
    ScanMatch open;
    open.status = ScanMatch::Status::kMatched;
    open.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kNone}};
    to_execute();
    driving(DrivingState::Kind::kDriving);
    for (int i = 0; i < 120; ++i) {
      open.utime = utime_;
      mission_.add_match(open);
      VehicleState state;
      state.utime = utime_;
      state.speed_m_s = 0.1 * i < seconds ? 0.2 : 0.0;
      mission_.add_vehicle_state(state);
      tick();
    }
  }
};

TEST_F(UnmeasuredMission, EndsWhereItHasHardlyMoved) {
  roll_unmeasured(5.0);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHomeUncertain);
  EXPECT_GT(phase().home_within_m, 1.0);  // 5 s at 0.2 m/s: never less than the truth
  EXPECT_LT(phase().home_within_m, 1.4);
  EXPECT_THAT(phase().reason, HasSubstr("no sensor measured the motion"));
  EXPECT_THAT(phase().return_home_reason, HasSubstr("no sensor measured the motion"));
}

TEST_F(UnmeasuredMission, IsSureAtTheStart) {
  roll_unmeasured(1.0);
  ASSERT_EQ(now(), Phase::kEnded);
  EXPECT_EQ(phase().outcome, MissionOutcome::kHome);
  EXPECT_GT(phase().home_within_m, 0.2);
  EXPECT_LT(phase().home_within_m, 0.5);
}

TEST_F(UnmeasuredMission, DrivesBackFromFartherAway) {
  roll_unmeasured(9.5);
  EXPECT_NE(now(), Phase::kEnded);
  EXPECT_TRUE(phase().returning_home);
}

TEST(RolledDistance, BoundsThereAndBack) {
  RolledDistance rolled;
  EXPECT_FALSE(rolled.bound_m());
  for (int i = 0; i <= 100; ++i) rolled.add({i * 100'000, i < 50 ? 0.3 : -0.3, 0.0});
  EXPECT_GT(*rolled.bound_m(), 3.0);
  rolled.add({20'000'000, 0.0, 0.0});
  EXPECT_FALSE(rolled.bound_m());  // after a gap
}

TEST_F(MissionTurnaround, ContinuesIfOdometryMeasuresMotion) {
  ScanMatch filled;
  filled.status = ScanMatch::Status::kMatched;
  filled.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kOdometry}};
  to_execute();
  for (int i = 0; i < 300; ++i) {
    filled.utime = utime_;
    mission_.add_match(filled);
    tick();
  }
  EXPECT_FALSE(phase().returning_home);
}

TEST_F(MissionTurnaround, IgnoresLostScansWithFewPoints) {
  ScanMatch open;
  open.status = ScanMatch::Status::kLost;
  open.points = 10;
  to_execute();
  drive(1.0);
  for (int i = 0; i < 1000; ++i) mission_.add_match(open);
  tick();
  EXPECT_FALSE(phase().returning_home);
}

TEST_F(MissionTurnaround, TurnsAroundIfScansDoNotMatchWhileItMoves) {
  ScanMatch lost;
  lost.status = ScanMatch::Status::kLost;
  lost.points = 100;
  to_scan();
  for (int i = 0; i < 1000; ++i) mission_.add_match(lost);
  tick();
  EXPECT_FALSE(phase().returning_home);
  to_execute();
  drive(1.0);
  for (int i = 0; i < 137; ++i) mission_.add_match(lost);  // 0.995^137 > 0.5
  tick();
  EXPECT_FALSE(phase().returning_home);
  for (int i = 0; i < 3; ++i) mission_.add_match(lost);
  expect_homeward("of the last scans do not match");
}

TEST_F(MissionTurnaround, PausesAndResumesByOrderInAnyPhase) {
  for (const Phase phase : {Phase::kExplore, Phase::kScan, Phase::kPlan, Phase::kExecute}) {
    to(phase);
    order(Order::kPause);
    EXPECT_EQ(now(), Phase::kPaused);
    const int requests = explores_ + scans_ + goals_;
    wait(10.0);
    EXPECT_EQ(now(), Phase::kPaused);
    EXPECT_EQ(explores_ + scans_ + goals_, requests);
    order(Order::kResume);
    tick();
    EXPECT_EQ(now(), Phase::kExplore);
  }
}

TEST_F(MissionTurnaround, ReturnsHomeByOrder) {
  to_execute();
  order(Order::kReturnHome);
  expect_homeward("by order");
  EXPECT_FALSE(phase().frontier);
}

TEST_F(MissionTurnaround, StopsByOrder) {
  to_execute();
  order(Order::kStop);
  EXPECT_EQ(phase().outcome, MissionOutcome::kStopped);
  order(Order::kResume);
  order(Order::kReturnHome);
  EXPECT_EQ(now(), Phase::kEnded);
}

TEST_F(MissionTurnaround, WaitsForTheOrderToStart) {
  MissionParams params;
  params.start = "on_order";
  mission_ = Mission(params);
  wait(5.0);
  EXPECT_EQ(now(), Phase::kPaused);
  order(Order::kResume);
  to_explore();
}

TEST_F(MissionTurnaround, AcceptsTheOrderToStartImmediately) {
  MissionParams params;
  params.start = "on_order";
  mission_ = Mission(params);
  tick();
  order(Order::kResume);  // before the next tick
  to_explore();
}

TEST_F(MissionTurnaround, WaitsForTheMapCorrectionInANewOdomFrame) {
  match(kStart);
  to_execute();
  match(utime_);
  EXPECT_EQ(now(), Phase::kWaiting);
  EXPECT_FALSE(phase().returning_home);
  wait(5.0);
  EXPECT_EQ(now(), Phase::kWaiting);
  map(utime_);
  tick();
  EXPECT_EQ(now(), Phase::kExplore);
}

TEST_F(MissionTurnaround, ScansStraightAheadWithoutAMapCorrection) {
  match(kStart);
  to_execute();
  match(utime_);
  wait(31.0);
  EXPECT_EQ(now(), Phase::kScan);
  EXPECT_THAT(phase().reason, HasSubstr("to recognise a place"));
}

}  // namespace
}  // namespace adit
