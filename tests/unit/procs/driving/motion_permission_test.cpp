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

TEST(LocalizationMonitor, RejectsStalePosesAndPosesFromTheFuture) {
  const LocalizationMonitor monitor({0.25, 0.5});
  EXPECT_EQ(monitor.lost_reason(kNow, std::nullopt), "no pose received yet");
  EXPECT_FALSE(monitor.lost_reason(kNow, kNow - 250'000));
  EXPECT_EQ(monitor.lost_reason(kNow, kNow - 250'001), "the newest pose is stale");
  EXPECT_FALSE(monitor.lost_reason(kNow, kNow + 250'000));
  EXPECT_EQ(monitor.lost_reason(kNow, kNow + 250'001), "the newest pose is from the future");
}

TEST(LocalizationMonitor, CountsFromTheFirstOfConsecutiveLostMatches) {
  LocalizationMonitor monitor({0.25, 0.5});
  for (std::int64_t after : {0, 200'000, 400'000}) monitor.add_match(kNow + after, Status::kLost);
  EXPECT_FALSE(monitor.lost_reason(kNow + 500'000, kNow + 500'000));
  EXPECT_EQ(monitor.lost_reason(kNow + 500'001, kNow + 500'001), "scan matching is lost");
  monitor.add_match(kNow + 600'000, Status::kMatched);
  EXPECT_FALSE(monitor.lost_reason(kNow + 600'000, kNow + 600'000));
  monitor.add_match(kNow + 700'000, Status::kLost);
  EXPECT_FALSE(monitor.lost_reason(kNow + 1'200'000, kNow + 1'200'000));
}

TEST(LocalizationMonitor, IsLostAfterAStepBackOfTheClock) {
  LocalizationMonitor monitor({0.25, 0.5});
  monitor.add_match(kNow, Status::kLost);
  EXPECT_TRUE(monitor.lost_reason(kNow - 3'600'000'000, kNow - 3'600'000'000));
}

constexpr std::int64_t kPeriodUs = 50'000;

MissionPhase phase_of(Phase phase, std::int32_t goal_id = 5) {
  MissionPhase message;
  message.phase = phase;
  message.goal_id = goal_id;
  return message;
}

TEST(MissionPermission, IsNotNeededWithoutAMission) {
  EXPECT_FALSE(MissionPermission().denial_reason(kNow, 5));
}

TEST(MissionPermission, CoversThePathOfThePhaseExecute) {
  MissionPermission permission;
  permission.update(phase_of(Phase::kExecute), kNow);
  EXPECT_FALSE(permission.denial_reason(kNow, 5));
  EXPECT_EQ(permission.denial_reason(kNow, 4), "the mission is executing another path");
  for (const Phase phase : {Phase::kWaiting, Phase::kExplore, Phase::kScan, Phase::kPlan,
                            Phase::kPaused, Phase::kEnded}) {
    permission.update(phase_of(phase), kNow);
    EXPECT_EQ(permission.denial_reason(kNow, 5), "the mission is not executing a path");
  }
}

TEST(MissionPermission, TimesOut) {
  MissionPermission permission;
  permission.update(phase_of(Phase::kExecute), kNow);
  EXPECT_FALSE(permission.denial_reason(kNow + MissionPermission::kTimeoutUs, 5));
  EXPECT_EQ(permission.denial_reason(kNow + MissionPermission::kTimeoutUs + 1, 5),
            "mission phase timed out");
}

TEST(DrivingWithAMission, StopsWhileThePhaseIsNotExecuteAndResumes) {
  Driving driving{DrivingParams{}};
  PlannedPath path = TestPathBuilder({}).forward(8.0).path();
  path.id = 5;
  std::int64_t utime = kNow;
  DriveOutput output;
  const auto run = [&](const MissionPhase& phase, double seconds) {
    for (int i = 0; i < 20 * seconds; ++i) {
      utime += kPeriodUs;
      driving.add_phase(phase, utime);
      driving.add_pose(utime, {});
      output = driving.drive(utime);
    }
  };
  run(phase_of(Phase::kPlan), 0.5);
  driving.follow(path);
  run(phase_of(Phase::kPlan), 1.0);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  EXPECT_EQ(output.state.kind, DrivingState::Kind::kWaiting);
  EXPECT_EQ(output.state.reason, "the mission is not executing a path");
  run(phase_of(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
  run(phase_of(Phase::kPaused), 0.1);
  EXPECT_EQ(output.command.speed_m_s, 0.0);
  run(phase_of(Phase::kExecute), 1.0);
  EXPECT_GT(output.command.speed_m_s, 0.0);
}

VehicleState state(double speed_m_s, bool stopped, bool expired) {
  VehicleState state;
  state.utime = kNow;
  state.speed_m_s = speed_m_s;
  state.stopped = stopped;
  state.expired = expired;
  return state;
}

TEST(VehicleFeedback, AssumesTheCommandedSpeedWithoutAFreshState) {
  const VehicleFeedback vehicle;
  EXPECT_EQ(vehicle.speed_m_s(kNow, 0.4), 0.4);
  EXPECT_EQ(vehicle.hold_reason(kNow), std::nullopt);
}

TEST(VehicleFeedback, LimitsThePredictedAcceleration) {
  VehicleFeedback vehicle;
  vehicle.update(state(-0.3, false, false));
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kNow + 50'000, -0.33), -0.33);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kNow + 50'000, 0.0), -0.2);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kNow + 150'000, -0.6), -0.5);
  EXPECT_EQ(vehicle.hold_reason(kNow), std::nullopt);
}

TEST(VehicleFeedback, HasTheMeasuredSpeedWhileHeld) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.1, true, false));
  EXPECT_EQ(vehicle.speed_m_s(kNow + 100'000, 0.05), 0.1);
}

TEST(VehicleFeedback, ReportsTheReasonOfAHold) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.0, true, true));
  EXPECT_EQ(vehicle.hold_reason(kNow), "held by a stop order");
  vehicle.update(state(0.0, false, true));
  EXPECT_EQ(vehicle.hold_reason(kNow), "held since drive commands timed out");
}

TEST(VehicleFeedback, IgnoresStatesThatAreStaleOrFromTheFuture) {
  VehicleFeedback vehicle;
  vehicle.update(state(0.3, true, false));
  for (const std::int64_t apart : {-300'000, 300'000}) {
    EXPECT_EQ(vehicle.speed_m_s(kNow + apart, 0.0), 0.0);
    EXPECT_EQ(vehicle.hold_reason(kNow + apart), std::nullopt);
  }
}

}  // namespace
}  // namespace adit
