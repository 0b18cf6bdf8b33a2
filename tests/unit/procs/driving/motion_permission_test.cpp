// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/motion_permission.hpp"

#include <gtest/gtest.h>

#include "procs/driving/driving.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

using Status = ScanMatch::Status;

constexpr std::int64_t kNow = 1'600'000'000'000'000;

TEST(LocalizationMonitor, DoubtsPosesThatAreTooOldOrYetToCome) {
  const LocalizationMonitor trust({0.25, 0.5});
  EXPECT_EQ(trust.lost_reason(kNow, std::nullopt), "no pose has come yet");
  EXPECT_FALSE(trust.lost_reason(kNow, kNow - 250'000));
  EXPECT_EQ(trust.lost_reason(kNow, kNow - 250'001), "the newest pose is too old");
  EXPECT_FALSE(trust.lost_reason(kNow, kNow + 250'000));
  EXPECT_EQ(trust.lost_reason(kNow, kNow + 250'001), "the newest pose is of a time to come");
}

TEST(LocalizationMonitor, CountsFromTheFirstOfManyLostMatches) {
  LocalizationMonitor trust({0.25, 0.5});
  for (std::int64_t after : {0, 200'000, 400'000}) trust.add_match(kNow + after, Status::kLost);
  EXPECT_FALSE(trust.lost_reason(kNow + 500'000, kNow + 500'000));
  EXPECT_EQ(trust.lost_reason(kNow + 500'001, kNow + 500'001), "scan matching is lost");
  trust.add_match(kNow + 600'000, Status::kMatched);
  EXPECT_FALSE(trust.lost_reason(kNow + 600'000, kNow + 600'000));
  trust.add_match(kNow + 700'000, Status::kLost);
  EXPECT_FALSE(trust.lost_reason(kNow + 1'200'000, kNow + 1'200'000));
}

TEST(LocalizationMonitor, DoubtsALossOfAnotherTime) {
  LocalizationMonitor trust({0.25, 0.5});
  trust.add_match(kNow, Status::kLost);
  EXPECT_TRUE(trust.lost_reason(kNow - 3'600'000'000, kNow - 3'600'000'000));
}

}  // namespace
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriodUs = 50'000;

MissionPhase in(Phase phase, std::int32_t goal_id = 5) {
  MissionPhase said;
  said.phase = phase;
  said.goal_id = goal_id;
  return said;
}

TEST(MotionPermission, IsNotNeededWhereThereIsNoMission) {
  EXPECT_FALSE(MotionPermission().denial_reason(kStart, 5));
}

TEST(MotionPermission, IsForThePathOfThePhaseExecute) {
  MotionPermission leave;
  leave.update(in(Phase::kExecute), kStart);
  EXPECT_FALSE(leave.denial_reason(kStart, 5));
  EXPECT_EQ(leave.denial_reason(kStart, 4), "the mission means another path");
  for (const Phase phase : {Phase::kWaiting, Phase::kExplore, Phase::kScan, Phase::kPlan,
                            Phase::kPaused, Phase::kEnded}) {
    leave.update(in(phase), kStart);
    EXPECT_EQ(leave.denial_reason(kStart, 5), "the mission is not executing a path");
  }
}

TEST(MotionPermission, ExpiresWhereTheMissionIsStale) {
  MotionPermission leave;
  leave.update(in(Phase::kExecute), kStart);
  EXPECT_FALSE(leave.denial_reason(kStart + MotionPermission::kTimeoutUs, 5));
  EXPECT_EQ(leave.denial_reason(kStart + MotionPermission::kTimeoutUs + 1, 5),
            "the mission is silent");
}

TEST(DrivingWithAMission, StandsWhileThePhaseIsNotExecuteAndGoesOnAfter) {
  Driving driving{DrivingParams{}};
  PlannedPath path = TestPathBuilder({}).forward(8.0).path();
  path.id = 5;
  std::int64_t utime = kStart;
  DriveOutput output;
  const auto run = [&](const MissionPhase& phase, double seconds) {
    for (int i = 0; i < 20 * seconds; ++i) {
      utime += kPeriodUs;
      driving.add_phase(phase, utime);
      driving.add_pose(utime, {});
      output = driving.drive(utime);
    }
  };
  run(in(Phase::kPlan), 0.5);
  driving.follow(path);
  run(in(Phase::kPlan), 1.0);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  EXPECT_EQ(output.state.kind, DrivingState::Kind::kWaiting);
  EXPECT_EQ(output.state.reason, "the mission is not executing a path");
  run(in(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
  run(in(Phase::kPaused), 0.1);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  run(in(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
}

}  // namespace
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

VehicleState state(double speed_m_s, bool stopped, bool expired) {
  VehicleState state;
  state.utime = kUtime;
  state.speed_m_s = speed_m_s;
  state.stopped = stopped;
  state.expired = expired;
  return state;
}

TEST(VehicleFeedback, BelievesThatOneObeysThatIsStale) {
  const VehicleFeedback vehicle;
  EXPECT_EQ(vehicle.speed_m_s(kUtime, 0.4), 0.4);
  EXPECT_EQ(vehicle.hold_reason(kUtime), std::nullopt);
}

TEST(VehicleFeedback, CanHaveComeToItsSpeedOnlySoFar) {
  VehicleFeedback vehicle;
  vehicle.update(state(-0.3, false, false));
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 50'000, -0.33), -0.33);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 50'000, 0.0), -0.2);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 150'000, -0.6), -0.5);
  EXPECT_EQ(vehicle.hold_reason(kUtime), std::nullopt);
}

TEST(VehicleFeedback, IsAsFastAsItSaysWhileItIsHeld) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.1, true, false));
  EXPECT_EQ(vehicle.speed_m_s(kUtime + 100'000, 0.05), 0.1);
}

TEST(VehicleFeedback, SaysWhyItIsHeld) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.0, true, true));
  EXPECT_EQ(vehicle.hold_reason(kUtime), "held by a stop order");
  vehicle.update(state(0.0, false, true));
  EXPECT_EQ(vehicle.hold_reason(kUtime), "held because commands come too late");
}

TEST(VehicleFeedback, ForgetsWhatIsOldOrOfAnotherTime) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.3, true, false));
  for (const std::int64_t apart : {-300'000, 300'000}) {
    EXPECT_EQ(vehicle.speed_m_s(kUtime + apart, 0.0), 0.0);
    EXPECT_EQ(vehicle.hold_reason(kUtime + apart), std::nullopt);
  }
}

}  // namespace
}  // namespace adit
