// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// When the vehicle may drive: at the start, after a stop, out of where it stands; and clocks.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(GuardRelease, StopsAtTheStartUntilAllDataIsReceived) {
  Guard guard(groundhog_guard());
  const StopOrder order = guard.evaluate(HealthyRobot::kStart);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "no pose received yet; no command received yet");

  HealthyRobot robot;
  robot.muted = {"front"};
  robot.run(2.0);
  EXPECT_EQ(robot.order.reason, "no laser front received yet");
  robot.muted = {};
  robot.run(0.3);
  EXPECT_THAT(robot.order.reason, StartsWith("release pending, was: no laser front received yet"));
  robot.run(0.4);
  EXPECT_FALSE(robot.order.stopped);
}

TEST(GuardRelease, NeedsACommandNewerThanTheStop) {
  Guard guard(groundhog_guard());
  std::int64_t now = HealthyRobot::kStart;
  guard.receive(DriveCommand{now, 0.0, 0.0}, now);
  guard.evaluate(now);  // no pose received yet
  guard.receive_pose({}, now + 500'000, now + 500'000);
  // An old command that is repeated is stale.
  guard.receive(DriveCommand{now, 0.0, 0.0}, now + 500'000);
  const StopOrder order = guard.evaluate(now + 500'000);
  EXPECT_TRUE(order.stopped);
  EXPECT_EQ(order.reason, "command stale for 0.50 s");
}

TEST(GuardRelease, AllowsToReverseFromAnObstacle) {
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

TEST(GuardRelease, IgnoresObstaclesWhileTheCommandIsToStand) {
  HealthyRobot robot;
  robot.speed_m_s = 0.0;
  robot.front = HealthyRobot::scan_with(0.25F, 101);
  robot.rear = HealthyRobot::scan_with(0.25F, 101);
  robot.muted = {"front"};
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardRelease, AllowsToLeaveBadAirInTheOppositeDirectionOnly) {
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

TEST(GuardRelease, DoesNotAlternate) {
  HealthyRobot robot;
  robot.run(2.0);
  for (int i = 0; i < 20; ++i) {
    robot.front = i % 2 == 0 ? HealthyRobot::scan_with(0.35F, 9) : HealthyRobot::free_scan();
    robot.run(0.2);
    EXPECT_TRUE(robot.order.stopped);
  }
}

/// Times that the order changes to stop.
int stops_of(HealthyRobot& robot, double seconds, const std::function<void(double)>& at) {
  int stops = 0;
  for (double t = 0.0; t < seconds; t += 0.01) {
    at(t);
    const bool was_stopped = robot.order.stopped;
    robot.run(0.01);
    stops += robot.order.stopped && !was_stopped ? 1 : 0;
  }
  return stops;
}

TEST(GuardRelease, StopsOnceForADistanceThatVariesAroundTheLimit) {
  HealthyRobot robot;
  robot.run(2.0);
  // At 0.3 m/s the limit is about 0.42 m from the laser. Each time for 0.9 s beyond it.
  const int stops = stops_of(robot, 10.0, [&](double t) {
    const bool is_near = std::fmod(t, 1.0) < 0.1;
    robot.front = HealthyRobot::scan_with(is_near ? 0.40F : 0.44F, 21);
  });
  EXPECT_EQ(stops, 1);  // without the margin it would be released between
  EXPECT_TRUE(robot.order.stopped);
}

TEST(GuardRelease, SlowsDownWhereOnlyCreepingIsFree) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.front = HealthyRobot::scan_with(0.40F, 21);  // free at 0.05 m/s, not at 0.3 m/s
  const int stops =
      stops_of(robot, 10.0, [&](double) { robot.speed_m_s = robot.order.stopped ? 0.05 : 0.3; });
  EXPECT_LE(stops, 5);  // released after 0.5, 1, 2, 4 s
}

TEST(GuardRelease, StopsAtOnceAlsoSoonAfterARelease) {
  HealthyRobot robot;
  robot.run(2.0);
  for (int i = 0; i < 4; ++i) {
    robot.front = HealthyRobot::scan_with(0.35F, 21);
    EXPECT_LE(robot.seconds_to_stop(1.0).value_or(1.0), 0.04) << i;  // with the next scan
    robot.front = HealthyRobot::free_scan();
    while (robot.order.stopped) robot.run(0.01);
  }
}

TEST(GuardClocks, AStepBackDoesNotHideAStaleSource) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  robot.muted = {"pose"};
  const auto seconds = robot.seconds_to_stop(1.0);
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(*seconds, 0.25, 0.04);  // the pose is up to 30 ms old, a step of the clock 10 ms
  EXPECT_THAT(robot.order.reason, StartsWith("pose stale"));
}

TEST(GuardClocks, AStepBackOfAllClocksDoesNotStopTheRobot) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = -3'600'000'000;
  EXPECT_EQ(robot.seconds_to_stop(2.0), std::nullopt) << robot.order.reason;
}

TEST(GuardClocks, AStepAheadStopsTheRobotBriefly) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.clock_ahead_us = 3'600'000'000;
  EXPECT_TRUE(robot.seconds_to_stop(0.1));
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardClocks, DataFromTheFutureCountsAsNow) {
  Guard guard(groundhog_guard());
  const std::int64_t now = HealthyRobot::kStart;
  guard.evaluate(now - 1'000'000);
  guard.receive_pose({}, now + 3'600'000'000, now);
  guard.receive(DriveCommand{now + 3'600'000'000, 0.0, 0.0}, now);
  EXPECT_FALSE(guard.evaluate(now).stopped);
  EXPECT_EQ(guard.evaluate(now + 300'000).reason,
            "pose stale for 0.30 s; command stale for 0.30 s");
}

TEST(GuardClocks, OldDataIsStaleHoweverOftenItArrives) {
  HealthyRobot robot;
  robot.run(2.0);
  robot.muted = {"pose"};
  Guard guard(groundhog_guard());
  for (int i = 0; i < 10; ++i) {
    const std::int64_t now = HealthyRobot::kStart + i * 50'000;
    guard.receive_pose({}, now - 1'000'000, now);
    guard.receive(DriveCommand{now, 0.0, 0.0}, now);
    EXPECT_EQ(guard.evaluate(now).reason, "pose stale for 1.00 s");
  }
}

}  // namespace
}  // namespace adit
