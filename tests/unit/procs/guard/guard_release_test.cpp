// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// When the vehicle may drive: at the start, after a stop, out of where it stands; and clocks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(GuardRelease, StandsAtTheStartUntilAllIsHeard) {
  Guard guard(groundhog_guard());
  const StopOrder order = guard.judge(HealthyRobot::kStart);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "no pose yet; no command yet");

  HealthyRobot robot;
  robot.silent = {"front"};
  robot.go_on(2.0);
  EXPECT_EQ(robot.order.reason, "no laser front yet");
  robot.silent = {};
  robot.go_on(0.3);
  EXPECT_THAT(robot.order.reason, StartsWith("to be released, was: no laser front yet"));
  robot.go_on(0.4);
  EXPECT_FALSE(robot.order.stopped);
}

TEST(GuardRelease, NeedsACommandThatIsNewerThanTheStop) {
  Guard guard(groundhog_guard());
  std::int64_t now = HealthyRobot::kStart;
  guard.hear(DriveCommand{now, 0.0, 0.0}, now);
  guard.judge(now);  // no pose yet
  guard.hear_pose({}, now + 500'000, now + 500'000);
  // The same command again and again, as if it were stuck somewhere: stale.
  guard.hear(DriveCommand{now, 0.0, 0.0}, now + 500'000);
  const StopOrder order = guard.judge(now + 500'000);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "command silent for 0.50 s");
}

TEST(GuardRelease, LetsTheVehicleBackAwayFromAnObstacle) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.front = HealthyRobot::scan_with(0.35F, 21);
  robot.go_on(1.0);
  EXPECT_THAT(robot.order.reason, StartsWith("obstacle"));
  robot.speed_m_s = -0.2;
  robot.go_on(0.4);
  EXPECT_TRUE(robot.order.stopped);
  robot.go_on(0.3);
  EXPECT_FALSE(robot.order.stopped);
  robot.speed_m_s = 0.2;
  EXPECT_TRUE(robot.seconds_to_stop(0.06));  // with the next command
}

TEST(GuardRelease, DoesNotMindWhatIsNearWhileTheVehicleIsToStand) {
  HealthyRobot robot;
  robot.speed_m_s = 0.0;
  robot.front = HealthyRobot::scan_with(0.25F, 101);
  robot.rear = HealthyRobot::scan_with(0.25F, 101);
  robot.silent = {"front"};
  robot.go_on(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardRelease, LetsTheVehicleLeaveBadAirBackwardsOnly) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.gas.methane_share = 0.02;
  robot.go_on(2.0);
  EXPECT_TRUE(robot.order.stopped);
  robot.speed_m_s = -0.2;
  robot.go_on(1.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
  robot.speed_m_s = 0.2;
  robot.go_on(0.1);
  EXPECT_THAT(robot.order.reason, HasSubstr("methane"));
}

TEST(GuardRelease, DoesNotFlutter) {
  HealthyRobot robot;
  robot.go_on(2.0);
  for (int i = 0; i < 20; ++i) {
    robot.front = i % 2 == 0 ? HealthyRobot::scan_with(0.35F, 9) : HealthyRobot::free_scan();
    robot.go_on(0.2);
    EXPECT_TRUE(robot.order.stopped);
  }
}

TEST(GuardClocks, AStepBackDoesNotKeepASilentSourceAlive) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  robot.silent = {"pose"};
  const auto seconds = robot.seconds_to_stop(1.0);
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(*seconds, 0.25, 0.04);  // the pose is up to 30 ms old, a step of the clock 10 ms
  EXPECT_THAT(robot.order.reason, StartsWith("pose silent"));
}

TEST(GuardClocks, AStepBackOfAllDoesNotStopTheRobot) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  EXPECT_EQ(robot.seconds_to_stop(2.0), std::nullopt) << robot.order.reason;
}

TEST(GuardClocks, AStepAheadStopsTheRobotForAMomentOnly) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.clock_ahead_us = 3'600'000'000;
  EXPECT_TRUE(robot.seconds_to_stop(0.1));
  robot.go_on(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardClocks, WhatIsOfTheFutureIsOfNow) {
  Guard guard(groundhog_guard());
  const std::int64_t now = HealthyRobot::kStart;
  guard.judge(now - 1'000'000);
  guard.hear_pose({}, now + 3'600'000'000, now);
  guard.hear(DriveCommand{now + 3'600'000'000, 0.0, 0.0}, now);
  EXPECT_FALSE(guard.judge(now).stopped);
  EXPECT_EQ(guard.judge(now + 300'000).reason, "pose silent for 0.30 s; command silent for 0.30 s");
}

TEST(GuardClocks, WhatIsOldIsStaleHoweverOftenItComes) {
  HealthyRobot robot;
  robot.go_on(2.0);
  robot.silent = {"pose"};
  Guard guard(groundhog_guard());
  for (int i = 0; i < 10; ++i) {
    const std::int64_t now = HealthyRobot::kStart + i * 50'000;
    guard.hear_pose({}, now - 1'000'000, now);
    guard.hear(DriveCommand{now, 0.0, 0.0}, now);
    EXPECT_EQ(guard.judge(now).reason, "pose silent for 1.00 s");
  }
}

}  // namespace
}  // namespace adit
