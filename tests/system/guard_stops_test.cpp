// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Each stop reason of the guard, provoked in the simulator: the vehicle stops without a collision.
// At Groundhog's 0.15 m/s it stops within 300 ms, of which braking at 0.8 m/s² takes 188 ms. The
// time counts from the message with the measurement, or from the timeout of a stale source: 250 ms
// for lasers, pose and commands, 3 s for the supervisor.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "tests/support/worlds/box_tunnel.hpp"
#include "tests/system/guarded_robot.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::Gt;
using testing::HasSubstr;
using testing::Le;
using testing::Optional;

constexpr double kGroundhogM_S = 0.15;
constexpr double kStopTimeMaxS = 0.3;
constexpr double kTimeoutS = 0.25;
constexpr double kFrontM = 1.2;  // from the vehicle centre to its front

class GuardStops : public testing::Test {
 protected:
  /// Drives for three seconds.
  static void start(GuardedRobot& robot, double speed_m_s = kGroundhogM_S) {
    robot.drive(speed_m_s);
    robot.run(3.0);
    ASSERT_FALSE(robot.order().stopped) << robot.order().reason;
    ASSERT_GT(robot.speed_m_s(), 0.8 * std::abs(speed_m_s));
  }
  static void expect_stop(GuardedRobot& robot, const std::function<bool()>& condition,
                          double seconds_max) {
    const auto seconds = robot.seconds_to_standstill(condition, seconds_max);
    EXPECT_THAT(seconds, Optional(AllOf(Gt(0.0), Le(kStopTimeMaxS + 1e-9))));  // rounding
    RecordProperty("stopping_time_ms", static_cast<int>(std::lround(1e3 * seconds.value_or(NAN))));
  }
  static void expect_reason(const GuardedRobot& robot, const std::string& text) {
    EXPECT_TRUE(robot.order().stopped);
    EXPECT_THAT(robot.order().reason, HasSubstr(text));
    EXPECT_EQ(robot.failure(), "");
  }
  static SimulationParams with_fault(const FaultDescription& fault) {
    SimulationParams params;
    params.faults = {fault};
    return params;
  }
};

/// Distance between the front of the stopped vehicle and an obstacle ahead.
double clearance_m(World world, double obstacle_x_m, double speed_m_s) {
  GuardedRobot robot(std::move(world));
  robot.drive(speed_m_s);
  robot.run(25.0);
  EXPECT_EQ(robot.failure(), "");
  EXPECT_EQ(robot.speed_m_s(), 0.0);
  EXPECT_THAT(robot.order().reason, HasSubstr("obstacle"));
  return obstacle_x_m - kFrontM - robot.motion().T_world_body.translation().x();
}

TEST_F(GuardStops, InFrontOfAWall) {
  for (const double speed : {0.15, 0.3, 0.5}) {
    const double clearance = clearance_m(box_tunnel({8.0, 4.0, 2.0}), 4.0, speed);
    EXPECT_GT(clearance, 0.15) << speed;  // safety margin
    EXPECT_LT(clearance, 0.35) << speed;
    RecordProperty("clearance_mm_at_mm_s_" + std::to_string(std::lround(1e3 * speed)),
                   static_cast<int>(std::lround(1e3 * clearance)));
  }
}

TEST_F(GuardStops, InFrontOfAPost) {
  for (const double y : {0.0, 0.3, -0.55}) {
    const auto post = [y](MeshBuilder& builder) {
      builder.begin_part(PartKind::kOther, Material::kTimber, "post");
      builder.bar({4.0, y, 0.0}, {4.0, y, 2.0}, 0.03);
    };
    const double clearance = clearance_m(box_tunnel({40.0, 4.0, 2.0}, post), 3.97, 0.4);
    EXPECT_GT(clearance, 0.1) << y;
    RecordProperty("clearance_mm_at_mm_" + std::to_string(std::lround(1e3 * y)),
                   static_cast<int>(std::lround(1e3 * clearance)));
  }
}

TEST_F(GuardStops, ForAnObstacleBehindInReverse) {
  GuardedRobot robot(box_tunnel({8.0, 4.0, 2.0}));
  robot.drive(-0.3);
  robot.run(20.0);
  expect_reason(robot, "m behind on the commanded arc");
  EXPECT_EQ(robot.speed_m_s(), 0.0);
}

TEST_F(GuardStops, ForAFailedLaser) {
  GuardedRobot robot(box_tunnel(), with_fault({"laser_dies", 3.5, "front", 0.0}));
  start(robot);
  const auto stale = [&] { return robot.message_age_s(channels::kLaserFront) > kTimeoutS; };
  expect_stop(robot, stale, 5.0);
  expect_reason(robot, "laser front stale");
}

TEST_F(GuardStops, ForAFailedRearLaserInReverse) {
  GuardedRobot robot(box_tunnel(), with_fault({"laser_dies", 3.5, "rear", 0.0}));
  start(robot, -kGroundhogM_S);
  const auto stale = [&] { return robot.message_age_s(channels::kLaserRear) > kTimeoutS; };
  expect_stop(robot, stale, 5.0);
  expect_reason(robot, "laser rear stale");
}

TEST_F(GuardStops, ForAStalePose) {
  GuardedRobot robot(box_tunnel());
  start(robot);
  robot.stop_localization();
  const auto stale = [&] { return robot.message_age_s(channels::kPose) > kTimeoutS; };
  expect_stop(robot, stale, 5.0);
  expect_reason(robot, "pose stale");
}

TEST_F(GuardStops, ForStaleCommands) {
  GuardedRobot robot(box_tunnel());
  start(robot);
  robot.stop_commands();
  const auto stale = [&] { return robot.message_age_s(channels::kDriveCommand) > kTimeoutS; };
  expect_stop(robot, stale, 5.0);
  expect_reason(robot, "command stale");
}

TEST_F(GuardStops, ForAStaleSupervisor) {
  GuardedRobot robot(box_tunnel());
  robot.set_supervised(true);
  start(robot);
  robot.run(5.0);
  EXPECT_FALSE(robot.order().stopped);
  robot.set_supervised(false);
  const auto stale = [&] { return robot.message_age_s(channels::kHeartbeat) > 3.0; };
  expect_stop(robot, stale, 10.0);
  expect_reason(robot, "supervisor stale");
}

TEST_F(GuardStops, ForRoll) {
  // The left wheels climb a slope of 0.2, so that the roll increases.
  GuardedRobot robot(box_tunnel({40.0, 4.0, 4.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kOther, Material::kRock, "bank");
    const auto corner = [&](double x, double y, double z) {
      return builder.vertex(Eigen::Vector3d(x, y, z).cast<float>());
    };
    builder.quad(corner(1.8, 0.1, 0.0), corner(6.8, 0.1, 1.0), corner(6.8, 2.0, 1.0),
                 corner(1.8, 2.0, 0.0));
  }));
  start(robot);
  const auto rolled = [&] {
    const Eigen::Matrix3d R = robot.motion().T_world_body.linear();
    return std::atan2(R(2, 1), R(2, 2)) > 0.4;
  };
  expect_stop(robot, rolled, 40.0);
  expect_reason(robot, "roll of 0.4");
}

TEST_F(GuardStops, ForMud) {
  World world = box_tunnel();
  world.soft_ground.push_back({"mud", {4.0, 0.0}, 2.0, 0.3});
  GuardedRobot robot(std::move(world));
  start(robot);
  const auto sunk = [&] { return std::ranges::max(robot.sinkage().depth_m) > 0.15; };
  expect_stop(robot, sunk, 40.0);
  expect_reason(robot, "wheel sunk in by 0.1");
}

TEST_F(GuardStops, ForGasAndPermitsReversing) {
  World world = box_tunnel();
  world.gas.push_back({"pocket", {6.0, 0.0}, 1.0, 0.05});
  GuardedRobot robot(std::move(world));
  start(robot);
  const auto has_gas = [&] { return robot.gas().methane_share >= 0.01; };
  expect_stop(robot, has_gas, 60.0);
  expect_reason(robot, "methane 1.");
  const double x_stop = robot.motion().T_world_body.translation().x();
  robot.drive(-kGroundhogM_S);
  robot.run(10.0);
  EXPECT_LT(robot.motion().T_world_body.translation().x(), x_stop - 1.0) << robot.order().reason;
}

struct RandomDrive {
  std::string failure;
  double path_length_m = 0.0;
};

/// Random commands for two minutes in a room with posts.
RandomDrive drive_randomly(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const auto posts = [&](MeshBuilder& builder) {
    builder.begin_part(PartKind::kOther, Material::kTimber, "posts");
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d foot(4.5 * share(random), 4.5 * share(random), 0.0);
      if (foot.norm() < 2.0) continue;  // start pose of the robot
      builder.bar(foot, foot + Eigen::Vector3d(0.0, 0.0, 2.0), 0.05);
    }
  };
  GuardedRobot robot(box_tunnel({10.0, 10.0, 2.0}, posts));
  for (int i = 0; i < 40 && robot.failure().empty(); ++i) {
    robot.drive(0.5 * share(random), 0.6 * share(random));
    robot.run(3.0);
  }
  return {robot.failure(), robot.distance_travelled_m()};
}

TEST_F(GuardStops, UnderRandomCommands) {
  // Seeds with a collision with a post outside the field of view, before the guard stored
  // obstacles.
  for (const std::uint32_t seed : {4U, 25U, 41U, 55U}) {
    const RandomDrive drive = drive_randomly(seed);
    EXPECT_EQ(drive.failure, "") << seed;
    EXPECT_GT(drive.path_length_m, 5.0) << seed;
    RecordProperty("metres_" + std::to_string(seed), static_cast<int>(drive.path_length_m));
  }
}

}  // namespace
}  // namespace adit
