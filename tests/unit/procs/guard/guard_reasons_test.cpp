// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Each reason to stand, provoked alone, and over again when it is gone.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

using testing::AnyOf;
using testing::DoubleNear;
using testing::Optional;
using testing::StartsWith;

class GuardReasons : public testing::Test {
 protected:
  GuardReasons() {
    robot_.run(2.0);
    EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
    EXPECT_EQ(robot_.order.reason, "");
  }

  /// Alone, and released half a second after it is gone.
  void expect_alone(StopKind kind, const std::string& text) {
    ASSERT_EQ(robot_.guard().reasons().size(), 1U) << robot_.order.reason;
    EXPECT_EQ(robot_.guard().reasons()[0].kind, kind);
    EXPECT_THAT(robot_.order.reason, StartsWith(text));
  }
  void expect_release() {
    robot_.run(0.4);
    EXPECT_TRUE(robot_.order.stopped);
    robot_.run(3.0);  // a mean that settles
    EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  }

  HealthyRobot robot_;
};

TEST_F(GuardReasons, AnObstacleOnTheArc) {
  robot_.front = HealthyRobot::scan_with(0.4F, 9);  // 0.25 m before the vehicle
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.0, 0.031)));  // the next scan
  expect_alone(StopKind::kObstacle,
               "obstacle 0.25 m ahead on the commanded arc, stopping takes 0.2");
  robot_.front = HealthyRobot::free_scan();
  expect_release();
}

TEST_F(GuardReasons, ThatAreNone) {
  robot_.front = HealthyRobot::scan_with(0.6F, 9);  // farther than it takes to stop
  robot_.rear = HealthyRobot::scan_with(0.4F, 9);   // behind
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt) << robot_.order.reason;
  robot_.front = HealthyRobot::scan_with(0.4F, 1);  // one beam
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt) << robot_.order.reason;
}

TEST_F(GuardReasons, AnObstacleHoweverSlowlyItCreeps) {
  robot_.speed_m_s = 0.001;
  robot_.front = HealthyRobot::scan_with(0.25F, 9);  // a tenth of a metre, and the margin is more
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_alone(StopKind::kObstacle, "obstacle 0.10 m ahead on the commanded arc");
}

TEST_F(GuardReasons, AnObstacleBehindInReverse) {
  robot_.speed_m_s = -0.3;
  robot_.rear = HealthyRobot::scan_with(0.4F, 9);
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_alone(StopKind::kObstacle, "obstacle 0.25 m behind on the commanded arc");
}

TEST_F(GuardReasons, AnObstacleOnTheArcThatTheVehicleIsStillOn) {
  robot_.curvature_1_m = 0.6;
  robot_.state.speed_m_s = 0.3;
  robot_.state.curvature_1_m = -0.6;
  // Beside its right front corner, where it goes only while it still steers to the right.
  robot_.front.ranges_m[16] = robot_.front.ranges_m[17] = 0.727F;
  EXPECT_TRUE(robot_.seconds_to_stop(0.2));
  EXPECT_THAT(robot_.order.reason, testing::HasSubstr("on the arc that it is on"));
}

TEST_F(GuardReasons, WhatItHasBegunToPassIsRememberedInATurn) {
  // A post 0.08 m beside its right flank comes into line with the laser, and goes out of its sight.
  robot_.front.ranges_m[0] = robot_.front.ranges_m[1] = robot_.front.ranges_m[2] = 0.68F;
  robot_.run(0.1);
  robot_.front = HealthyRobot::free_scan();
  for (int i = 0; i < 75; ++i) {
    robot_.T_odom_body.x += 0.02;
    robot_.run(0.03);
  }
  EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  robot_.curvature_1_m = 0.6;  // to the left, so that its rear swings out
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_alone(StopKind::kObstacle, "remembered obstacle 0.");
}

TEST_F(GuardReasons, AStaleLaserWhereItDrives) {
  robot_.muted = {"rear"};
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt);
  robot_.muted = {"front"};
  // 27 ms are gone when the scan comes, 30 ms more until the next should have.
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.22, 0.03)));
  expect_alone(StopKind::kLaser, "laser front silent for 0.2");
  robot_.muted = {};
  expect_release();
  robot_.speed_m_s = -0.3;
  robot_.muted = {"rear"};
  EXPECT_TRUE(robot_.seconds_to_stop(0.3));
  expect_alone(StopKind::kLaser, "laser rear silent for 0.2");
}

TEST_F(GuardReasons, ALaserThatIsCovered) {
  robot_.front.ranges_m.assign(361, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_alone(StopKind::kLaser, "laser front blind, 0 of 361 beams return");
  robot_.front.ranges_m.clear();
  robot_.run(0.1);
  expect_alone(StopKind::kLaser, "laser front blind, 0 of 0 beams return");
  robot_.front = HealthyRobot::free_scan();
  expect_release();
}

TEST_F(GuardReasons, ATiltThatIsNotKnownAnyMore) {
  robot_.muted = {"tilt"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.03)));
  expect_alone(StopKind::kLaser, "tilt of laser front silent for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, AStalePose) {
  robot_.muted = {"pose"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.03)));
  expect_alone(StopKind::kPose, "pose silent for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, StaleCommands) {
  robot_.muted = {"command"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.05)));
  expect_alone(StopKind::kCommand, "command silent for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, RollAndPitch) {
  for (const auto& [force, text] :
       {std::pair<Eigen::Vector3d, const char*>{{0.0, 4.5, 8.7}, "roll of 0.4"},
        {{-4.5, 0.0, 8.7}, "pitch of -0.4"}}) {
    robot_.imu.linear_acceleration = force;  // 0.48 rad
    EXPECT_TRUE(robot_.seconds_to_stop(3.0));
    expect_alone(StopKind::kTilt, text);
    robot_.imu.linear_acceleration = {0.0, 0.0, 9.81};
    expect_release();
  }
}

TEST_F(GuardReasons, NoBumpOverARail) {
  for (int i = 0; i < 20; ++i) {
    robot_.imu.linear_acceleration = {20.0, 30.0, 9.81};
    robot_.run(0.03);
    robot_.imu.linear_acceleration = {0.0, 0.0, 9.81};
    robot_.run(0.2);
    EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  }
}

TEST_F(GuardReasons, AnInertialUnitThatWasReceivedAndIsNoMore) {
  robot_.muted = {"imu"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.02)));
  expect_alone(StopKind::kTilt, "inertial unit silent for 0.2");
}

TEST_F(GuardReasons, AnInertialUnitThatFeelsNoGravity) {
  robot_.imu.linear_acceleration = {0.0, 0.0, 1.0};  // in units of g
  EXPECT_THAT(robot_.seconds_to_stop(11.0), Optional(DoubleNear(10.0, 0.1)));
  expect_alone(StopKind::kTilt, "inertial unit without gravity");
}

TEST_F(GuardReasons, Sinkage) {
  robot_.sinkage.depth_m = {0.0, 0.16, 0.0, 0.0};
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_alone(StopKind::kSinkage, "front right wheel sunk in by 0.16 m, limit 0.15 m");
  robot_.sinkage = {};
  expect_release();
  robot_.muted = {"sinkage"};
  EXPECT_THAT(robot_.seconds_to_stop(3.0), Optional(DoubleNear(1.5, 0.1)));
  expect_alone(StopKind::kSinkage, "sinkage silent for 1.5");
}

TEST_F(GuardReasons, Gas) {
  robot_.gas.methane_share = 0.012;
  EXPECT_TRUE(robot_.seconds_to_stop(0.51));
  expect_alone(StopKind::kGas, "methane 1.20 %, limit 1.00 %");
  robot_.gas = {};
  expect_release();
  robot_.muted = {"gas"};
  EXPECT_THAT(robot_.seconds_to_stop(3.0), Optional(DoubleNear(1.5, 0.51)));
  expect_alone(StopKind::kGas, "gas silent for 1.5");
}

TEST_F(GuardReasons, ADeadSupervisor) {
  robot_.muted = {"supervisor"};
  EXPECT_THAT(robot_.seconds_to_stop(5.0), Optional(DoubleNear(3.0, 1.0)));
  expect_alone(StopKind::kSupervisor, "supervisor silent for 3.0");
  robot_.muted = {};
  robot_.run(1.0);
  expect_release();
}

TEST_F(GuardReasons, AreToldTogetherInTheirOrderAndCounted) {
  EXPECT_EQ(robot_.guard().counts().at(static_cast<std::size_t>(StopKind::kObstacle)), 0);
  robot_.muted = {"pose", "front"};
  robot_.gas.methane_share = 0.5;
  robot_.run(1.0);
  EXPECT_THAT(robot_.order.reason,
              testing::MatchesRegex("laser front silent for .* s; pose silent for .* s; "
                                    "methane 50.00 %, limit 1.00 %"));
  const auto before = robot_.guard().counts();
  robot_.muted = {};
  robot_.run(1.0);
  robot_.muted = {"pose"};
  robot_.run(1.0);
  const auto after = robot_.guard().counts();
  const auto grown = [&](StopKind kind) {
    const auto i = static_cast<std::size_t>(kind);
    return after.at(i) - before.at(i);
  };
  EXPECT_EQ(grown(StopKind::kPose), 1);
  EXPECT_EQ(grown(StopKind::kLaser), 0);
  EXPECT_EQ(grown(StopKind::kGas), 0);
}

TEST(GuardOptions, SensorsThatNeverSpokeAreNotMissed) {
  HealthyRobot robot;
  robot.muted = {"imu", "gas", "sinkage", "supervisor", "tilt", "state"};
  robot.run(5.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardOptions, ASupervisorMayBeRequiredFromTheStart) {
  GuardParams params = groundhog_guard();
  params.require_supervisor = true;
  HealthyRobot robot(params);
  robot.muted = {"supervisor"};
  robot.run(2.0);
  EXPECT_EQ(robot.order.reason, "no supervisor yet");
  robot.muted = {};
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped);
}

}  // namespace
}  // namespace adit
