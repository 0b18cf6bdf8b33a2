// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Each reason to stand, provoked alone, and over again when it is gone.
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

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

  /// The only reason; the release follows half a second after its end.
  void expect_only(StopKind kind, const std::string& text) {
    ASSERT_EQ(robot_.guard().reasons().size(), 1U) << robot_.order.reason;
    EXPECT_EQ(robot_.guard().reasons()[0].kind, kind);
    EXPECT_THAT(robot_.order.reason, StartsWith(text));
  }
  void expect_release() {
    robot_.run(0.4);
    EXPECT_TRUE(robot_.order.stopped);
    robot_.run(3.0);  // the settling time of a mean
    EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  }

  HealthyRobot robot_;
};

TEST_F(GuardReasons, StopsForAnObstacleOnTheArc) {
  robot_.front = HealthyRobot::scan_with(0.4F, 9);  // 0.25 m ahead of the vehicle
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.0, 0.031)));  // with the next scan
  expect_only(StopKind::kObstacle,
              "obstacle 0.25 m ahead on the commanded arc, stopping distance 0.2");
  robot_.front = HealthyRobot::free_scan();
  expect_release();
}

TEST_F(GuardReasons, IgnoresFarObstaclesObstaclesBehindAndSingleBeams) {
  robot_.front = HealthyRobot::scan_with(0.6F, 9);  // beyond the stopping distance
  robot_.rear = HealthyRobot::scan_with(0.4F, 9);   // behind
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt) << robot_.order.reason;
  robot_.front = HealthyRobot::scan_with(0.4F, 1);  // one beam
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt) << robot_.order.reason;
}

/// A wall that the vehicle passes closely and that only its side margin meets.
TEST_F(GuardReasons, StopsForAWallBesideThePathOnlyShortlyBeforeContact) {
  robot_.speed_m_s = 0.05;
  robot_.run(0.2);
  const auto see = [&](double angle_rad) {
    robot_.front = HealthyRobot::free_scan();
    for (int i = 0; i < 2; ++i) {
      const auto beam =
          std::lround((angle_rad + std::numbers::pi / 2.0) * 360.0 / std::numbers::pi) + i;
      const double at_rad =
          static_cast<double>(beam) * std::numbers::pi / 360.0 - std::numbers::pi / 2.0;
      // 5 mm beside the flank
      robot_.front.ranges_m[static_cast<std::size_t>(beam)] =
          static_cast<float>(0.605 / std::sin(at_rad));
    }
  };
  see(std::atan2(0.605, 0.25));  // 0.1 m ahead of the nose
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt) << robot_.order.reason;
  see(std::atan2(0.605, 0.18));  // 0.03 m ahead of it
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kObstacle, "obstacle 0.0");
}

TEST_F(GuardReasons, StopsForAnObstacleAtAnySpeed) {
  robot_.speed_m_s = 0.001;
  robot_.front = HealthyRobot::scan_with(0.25F, 9);  // 0.1 m, less than the margin
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kObstacle, "obstacle 0.10 m ahead on the commanded arc");
}

TEST_F(GuardReasons, StopsForAnObstacleBehindInReverse) {
  robot_.speed_m_s = -0.3;
  robot_.rear = HealthyRobot::scan_with(0.4F, 9);
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kObstacle, "obstacle 0.25 m behind on the commanded arc");
}

TEST_F(GuardReasons, StopsForAnObstacleOnTheMeasuredArc) {
  robot_.curvature_1_m = 0.6;
  robot_.state.speed_m_s = 0.3;
  robot_.state.curvature_1_m = -0.6;
  // Beside its right front corner, which only the measured arc meets.
  robot_.front.ranges_m[16] = robot_.front.ranges_m[17] = 0.727F;
  EXPECT_TRUE(robot_.seconds_to_stop(0.2));
  EXPECT_THAT(robot_.order.reason, testing::HasSubstr("on the measured arc"));
}

TEST_F(GuardReasons, StopsForARememberedObstacleInATurn) {
  // A post 0.08 m beside its right flank passes the laser and leaves its view.
  robot_.front.ranges_m[0] = robot_.front.ranges_m[1] = robot_.front.ranges_m[2] = 0.68F;
  robot_.run(0.1);
  robot_.front = HealthyRobot::free_scan();
  for (int i = 0; i < 75; ++i) {
    robot_.T_odom_body.x += 0.02;
    robot_.run(0.03);
  }
  EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  robot_.curvature_1_m = 0.6;  // to the left: the rear swings out
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kObstacle, "remembered obstacle 0.");
}

TEST_F(GuardReasons, StopsForAStaleLaserInTheDirectionOfMotion) {
  robot_.muted = {"rear"};
  EXPECT_EQ(robot_.seconds_to_stop(1.0), std::nullopt);
  robot_.muted = {"front"};
  // A scan is 27 ms old on arrival; the next one is due 30 ms later.
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.22, 0.03)));
  expect_only(StopKind::kLaser, "laser front stale for 0.2");
  robot_.muted = {};
  expect_release();
  robot_.speed_m_s = -0.3;
  robot_.muted = {"rear"};
  EXPECT_TRUE(robot_.seconds_to_stop(0.3));
  expect_only(StopKind::kLaser, "laser rear stale for 0.2");
}

TEST_F(GuardReasons, StopsForACoveredLaser) {
  robot_.front.ranges_m.assign(361, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kLaser, "laser front blind, 0 of 361 beams return");
  robot_.front.ranges_m.clear();
  robot_.run(0.1);
  expect_only(StopKind::kLaser, "laser front blind, 0 of 0 beams return");
  robot_.front = HealthyRobot::free_scan();
  expect_release();
}

TEST_F(GuardReasons, StopsForAStaleTilt) {
  robot_.muted = {"tilt"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.03)));
  expect_only(StopKind::kLaser, "tilt of laser front stale for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, StopsForAStalePose) {
  robot_.muted = {"pose"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.03)));
  expect_only(StopKind::kPose, "pose stale for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, StopsForStaleCommands) {
  robot_.muted = {"command"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.05)));
  expect_only(StopKind::kCommand, "command stale for 0.2");
  robot_.muted = {};
  expect_release();
}

TEST_F(GuardReasons, StopsForRollAndPitch) {
  for (const auto& [force, text] :
       {std::pair<Eigen::Vector3d, const char*>{{0.0, 4.5, 8.7}, "roll of 0.4"},
        {{-4.5, 0.0, 8.7}, "pitch of -0.4"}}) {
    robot_.imu.linear_acceleration = force;  // 0.48 rad
    EXPECT_TRUE(robot_.seconds_to_stop(3.0));
    expect_only(StopKind::kTilt, text);
    robot_.imu.linear_acceleration = {0.0, 0.0, 9.81};
    expect_release();
  }
}

TEST_F(GuardReasons, IgnoresABumpOverARail) {
  for (int i = 0; i < 20; ++i) {
    robot_.imu.linear_acceleration = {20.0, 30.0, 9.81};
    robot_.run(0.03);
    robot_.imu.linear_acceleration = {0.0, 0.0, 9.81};
    robot_.run(0.2);
    EXPECT_FALSE(robot_.order.stopped) << robot_.order.reason;
  }
}

TEST_F(GuardReasons, StopsForAStaleImu) {
  robot_.muted = {"imu"};
  EXPECT_THAT(robot_.seconds_to_stop(1.0), Optional(DoubleNear(0.25, 0.02)));
  expect_only(StopKind::kTilt, "IMU stale for 0.2");
}

TEST_F(GuardReasons, StopsForAnImuWithoutGravity) {
  robot_.imu.linear_acceleration = {0.0, 0.0, 1.0};  // in units of g
  EXPECT_THAT(robot_.seconds_to_stop(11.0), Optional(DoubleNear(10.0, 0.1)));
  expect_only(StopKind::kTilt, "IMU without gravity");
}

TEST_F(GuardReasons, StopsForSinkage) {
  robot_.sinkage.depth_m = {0.0, 0.16, 0.0, 0.0};
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kSinkage, "front right wheel sunk in by 0.16 m, limit 0.15 m");
  robot_.sinkage = {};
  expect_release();
  robot_.muted = {"sinkage"};
  EXPECT_THAT(robot_.seconds_to_stop(3.0), Optional(DoubleNear(1.5, 0.1)));
  expect_only(StopKind::kSinkage, "sinkage stale for 1.5");
}

/// The mission turned around at the first centimetres of mud; the vehicle still came farther in
/// while it braked, and the reading was late. It may leave as it came.
TEST_F(GuardReasons, PermitsToLeaveMudThatWasMeasuredAfterTheCommandToReverse) {
  robot_.state.speed_m_s = robot_.speed_m_s;
  robot_.run(3.0);
  robot_.speed_m_s = -0.3;
  robot_.run(0.2);
  robot_.sinkage.depth_m = {0.0, 0.16, 0.0, 0.0};
  robot_.state.speed_m_s = -0.3;
  EXPECT_FALSE(robot_.seconds_to_stop(5.0));
  robot_.speed_m_s = 0.3;
  EXPECT_TRUE(robot_.seconds_to_stop(0.1));
  expect_only(StopKind::kSinkage, "front right wheel sunk in by 0.16 m, limit 0.15 m");
}

TEST_F(GuardReasons, StopsForGas) {
  robot_.gas.methane_share = 0.012;
  EXPECT_TRUE(robot_.seconds_to_stop(0.51));
  expect_only(StopKind::kGas, "methane 1.20 %, limit 1.00 %");
  robot_.gas = {};
  expect_release();
  robot_.muted = {"gas"};
  EXPECT_THAT(robot_.seconds_to_stop(3.0), Optional(DoubleNear(1.5, 0.51)));
  expect_only(StopKind::kGas, "gas stale for 1.5");
}

TEST_F(GuardReasons, StopsForAStaleSupervisor) {
  robot_.muted = {"supervisor"};
  EXPECT_THAT(robot_.seconds_to_stop(5.0), Optional(DoubleNear(3.0, 1.0)));
  expect_only(StopKind::kSupervisor, "supervisor stale for 3.0");
  robot_.muted = {};
  robot_.run(1.0);
  expect_release();
}

TEST_F(GuardReasons, ReportsAndCountsAllReasonsInOrder) {
  EXPECT_EQ(robot_.guard().counts().at(static_cast<std::size_t>(StopKind::kObstacle)), 0);
  robot_.muted = {"pose", "front"};
  robot_.gas.methane_share = 0.5;
  robot_.run(1.0);
  EXPECT_THAT(robot_.order.reason,
              testing::MatchesRegex("laser front stale for .* s; pose stale for .* s; "
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

TEST(GuardOptions, OptionalSensorsAreNotRequired) {
  HealthyRobot robot;
  robot.muted = {"imu", "gas", "sinkage", "supervisor", "tilt", "state"};
  robot.run(5.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardOptions, ASupervisorCanBeRequiredFromTheStart) {
  GuardParams params = groundhog_guard();
  params.require_supervisor = true;
  HealthyRobot robot(params);
  robot.muted = {"supervisor"};
  robot.run(2.0);
  EXPECT_EQ(robot.order.reason, "no supervisor received yet");
  robot.muted = {};
  robot.run(2.0);
  EXPECT_FALSE(robot.order.stopped);
}

}  // namespace
}  // namespace adit
