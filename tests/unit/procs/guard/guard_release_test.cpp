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

TEST(GuardRelease, StandsAtTheStartUntilAllIsReceived) {
  Guard guard(groundhog_guard());
  const StopOrder order = guard.evaluate(HealthyRobot::kStart);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "no pose yet; no command yet");

  HealthyRobot robot;
  robot.muted = {"front"};
  robot.run(2.0);
  EXPECT_EQ(robot.order.reason, "no laser front yet");
  robot.muted = {};
  robot.run(0.3);
  EXPECT_THAT(robot.order.reason, StartsWith("to be released, was: no laser front yet"));
  robot.run(0.4);
  EXPECT_FALSE(robot.order.stopped);
}

TEST(GuardRelease, NeedsACommandThatIsNewerThanTheStop) {
  Guard guard(groundhog_guard());
  std::int64_t now = HealthyRobot::kStart;
  guard.receive(DriveCommand{now, 0.0, 0.0}, now);
  guard.evaluate(now);  // no pose yet
  guard.receive_pose({}, now + 500'000, now + 500'000);
  // The same command again and again, as if it were stuck somewhere: stale.
  guard.receive(DriveCommand{now, 0.0, 0.0}, now + 500'000);
  const StopOrder order = guard.evaluate(now + 500'000);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "command silent for 0.50 s");
}

TEST(GuardRelease, LetsTheVehicleBackAwayFromAnObstacle) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.front = HealthyRobot::scan_with(0.35F, 21);
  robot.run(1.0);
  EXPECT_THAT(robot.order.reason, StartsWith("obstacle"));
  robot.speed_m_s = -0.2;
  robot.run(0.4);
  EXPECT_TRUE(robot.order.stopped);
  robot.run(0.3);
  EXPECT_FALSE(robot.order.stopped);
  robot.speed_m_s = 0.2;
  EXPECT_TRUE(robot.seconds_to_stop(0.06));  // with the next command
}

TEST(GuardRelease, DoesNotMindWhatIsNearWhileTheVehicleIsToStand) {
  HealthyRobot robot;
  robot.speed_m_s = 0.0;
  robot.front = HealthyRobot::scan_with(0.25F, 101);
  robot.rear = HealthyRobot::scan_with(0.25F, 101);
  robot.muted = {"front"};
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardRelease, LetsTheVehicleLeaveBadAirBackwardsOnly) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.gas.methane_share = 0.02;
  robot.run(2.0);
  EXPECT_TRUE(robot.order.stopped);
  robot.speed_m_s = -0.2;
  robot.run(1.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
  robot.speed_m_s = 0.2;
  robot.run(0.1);
  EXPECT_THAT(robot.order.reason, HasSubstr("methane"));
}

TEST(GuardRelease, DoesNotFlutter) {
  HealthyRobot robot;
  robot.run(2.0);
  for (int i = 0; i < 20; ++i) {
    robot.front = i % 2 == 0 ? HealthyRobot::scan_with(0.35F, 9) : HealthyRobot::free_scan();
    robot.run(0.2);
    EXPECT_TRUE(robot.order.stopped);
  }
}

TEST(GuardClocks, AStepBackDoesNotKeepAStaleSourceAlive) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  robot.muted = {"pose"};
  const auto seconds = robot.seconds_to_stop(1.0);
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(*seconds, 0.25, 0.04);  // the pose is up to 30 ms old, a step of the clock 10 ms
  EXPECT_THAT(robot.order.reason, StartsWith("pose silent"));
}

TEST(GuardClocks, AStepBackOfAllDoesNotStopTheRobot) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  EXPECT_EQ(robot.seconds_to_stop(2.0), std::nullopt) << robot.order.reason;
}

TEST(GuardClocks, AStepAheadStopsTheRobotForAMomentOnly) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = 3'600'000'000;
  EXPECT_TRUE(robot.seconds_to_stop(0.1));
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardClocks, WhatIsOfTheFutureIsOfNow) {
  Guard guard(groundhog_guard());
  const std::int64_t now = HealthyRobot::kStart;
  guard.evaluate(now - 1'000'000);
  guard.receive_pose({}, now + 3'600'000'000, now);
  guard.receive(DriveCommand{now + 3'600'000'000, 0.0, 0.0}, now);
  EXPECT_FALSE(guard.evaluate(now).stopped);
  EXPECT_EQ(guard.evaluate(now + 300'000).reason,
            "pose silent for 0.30 s; command silent for 0.30 s");
}

TEST(GuardClocks, WhatIsOldIsStaleHoweverOftenItComes) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.muted = {"pose"};
  Guard guard(groundhog_guard());
  for (int i = 0; i < 10; ++i) {
    const std::int64_t now = HealthyRobot::kStart + i * 50'000;
    guard.receive_pose({}, now - 1'000'000, now);
    guard.receive(DriveCommand{now, 0.0, 0.0}, now);
    EXPECT_EQ(guard.evaluate(now).reason, "pose silent for 1.00 s");
  }
}

}  // namespace
}  // namespace adit
