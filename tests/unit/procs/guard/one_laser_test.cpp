// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A guard of a robot with one laser, which is blind behind.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "procs/guard/blind_side_memory.hpp"
#include "tests/unit/procs/guard/healthy_robot.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

GuardParams one_laser() {
  GuardParams params = groundhog_guard();
  params.lasers.count = 1;
  return params;
}

/// Drives by setting poses; the wheels follow.
void drive(HealthyRobot& robot, double distance_m) {
  constexpr double kCycleM = 0.003;  // per cycle of 10 ms
  robot.speed_m_s = distance_m > 0.0 ? 0.3 : -0.3;
  for (int i = 0; i < std::lround(std::abs(distance_m) / kCycleM); ++i) {
    robot.T_odom_body.x += distance_m > 0.0 ? kCycleM : -kCycleM;
    robot.run(0.01);
  }
}

TEST(GuardWithOneLaser, NeedsNoRearLaserAhead) {
  HealthyRobot robot(one_laser());
  robot.muted = {"rear"};
  robot.run(3.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardWithOneLaser, DoesNotReverseIntoWhatItHasNotSeen) {
  HealthyRobot robot(one_laser());
  robot.muted = {"rear"};
  robot.run(3.0);
  robot.speed_m_s = -0.3;
  robot.run(0.1);
  EXPECT_TRUE(robot.order.stopped);
  EXPECT_THAT(robot.order.reason, HasSubstr("blind behind"));
}

TEST(GuardWithOneLaser, ReversesAsFarAsItCame) {
  HealthyRobot robot(one_laser());
  robot.muted = {"rear"};
  robot.run(3.0);
  drive(robot, 3.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
  drive(robot, -2.6);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
  // The stopping distance at 0.3 m/s, 0.3 * 0.1 + 0.3² / 1.2, is 0.105 m.
  drive(robot, -0.4);
  EXPECT_TRUE(robot.order.stopped);
  EXPECT_THAT(robot.order.reason, HasSubstr("blind behind"));
}

TEST(GuardWithOneLaser, StopsInReverseWithoutScansOfTheFrontLaser) {
  HealthyRobot robot(one_laser());
  robot.muted = {"rear"};
  robot.run(3.0);
  drive(robot, 2.0);
  robot.muted = {"rear", "front"};
  drive(robot, -0.5);
  EXPECT_TRUE(robot.order.stopped);
  EXPECT_THAT(robot.order.reason, HasSubstr("laser front"));
}

TEST(GuardWithOneLaser, ForgetsWhatItSawWhenThePoseJumps) {
  HealthyRobot robot(one_laser());
  robot.muted = {"rear"};
  robot.run(3.0);
  drive(robot, 3.0);
  robot.T_odom_body.y += 5.0;
  robot.speed_m_s = -0.3;
  robot.run(0.1);
  EXPECT_THAT(robot.order.reason, HasSubstr("blind behind"));
}

GuardParams spinning_lidar() {
  GuardParams params = one_laser();
  params.lasers.front.T_body_laser.x = 0.6;
  params.lasers.front.range_min_m = 0.5;
  params.vehicle.length_m = 2.0;
  params.lasers.lidar.present = true;
  return params;
}

LaserScan all_around() {
  return {0, std::vector<float>(720, 8.0F), -std::numbers::pi, std::numbers::pi / 360.0};
}

TEST(GuardWithASpinningLidar, ReversesWhereNothingIsBehind) {
  HealthyRobot robot(spinning_lidar());
  robot.muted = {"rear", "tilt"};
  robot.front = all_around();
  robot.run(3.0);
  robot.speed_m_s = -0.3;
  robot.run(1.0);
  EXPECT_FALSE(robot.order.stopped) << robot.order.reason;
}

TEST(GuardWithASpinningLidar, StopsInReverseForAnObstacle) {
  HealthyRobot robot(spinning_lidar());
  robot.muted = {"rear", "tilt"};
  robot.front = all_around();
  robot.run(3.0);
  std::fill_n(robot.front.ranges_m.begin(), 10, 1.75F);  // 0.15 m behind the body
  robot.speed_m_s = -0.3;
  robot.run(0.1);
  EXPECT_TRUE(robot.order.stopped);
  EXPECT_THAT(robot.order.reason, HasSubstr("behind"));
}

TEST(GuardWithASpinningLidar, StopsInReverseWithoutItsScans) {
  HealthyRobot robot(spinning_lidar());
  robot.muted = {"rear", "tilt"};
  robot.front = all_around();
  robot.run(3.0);
  robot.muted.insert("front");
  robot.speed_m_s = -0.3;
  robot.run(0.5);
  EXPECT_TRUE(robot.order.stopped);
  EXPECT_THAT(robot.order.reason, HasSubstr("laser front"));
}

TEST(BlindSideMemory, KnowsWhatLiesBetweenTheLaserAndAnObstacle) {
  Vehicle vehicle;
  vehicle.length_m = 0.8;
  vehicle.width_m = 0.6;
  LaserMount laser;
  BlindSideMemory ground(vehicle, laser);
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 0.2), 0.0);
  ground.move_to({});
  // Beams all around that end 2 m away: known up to there for the body's rear edge.
  LaserPoints points;
  for (int i = 0; i < 720; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 720.0;
    points.p_body.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle));
  }
  ground.observe(points);
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 1.0), 1.0);
  // The corners of the body, (-0.4, ±0.3), reach the circle after 1.98 - 0.4 m.
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 3.0), 1.58, 0.15);  // a cell and a half
}

TEST(BlindSideMemory, KnowsThePathOfTheLast60Metres) {
  Vehicle vehicle;
  BlindSideMemory ground(vehicle, LaserMount{});
  for (int i = 0; i <= 800; ++i) ground.move_to({0.1 * i, 0.0, 0.0});
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 59.0), 59.0);
  EXPECT_LT(ground.known_m({-0.3, 0.0}, 70.0), 61.0);
  for (int i = 800; i >= 600; --i) ground.move_to({0.1 * i, 0.0, 0.0});
  EXPECT_EQ(ground.known_m({0.3, 0.0}, 19.0), 19.0);  // driven twice
}

/// The last footprint that was added is a few centimetres behind: those ahead of it are no unknown
/// ground. A vehicle that turned into a recess could not leave it again.
TEST(BlindSideMemory, KnowsTheGroundUnderTheBody) {
  Vehicle vehicle;
  BlindSideMemory ground(vehicle, LaserMount{});
  for (int i = 0; i <= 20; ++i) ground.move_to({0.1 * i, 0.0, 0.0});
  ground.move_to({2.04, 0.0, 0.0});
  EXPECT_EQ(ground.known_m({-0.05, 0.0}, 0.01), 0.01);
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 1.0), 1.0);
}

TEST(BlindSideMemory, IsNotExtendedByCreeping) {
  Vehicle vehicle;
  BlindSideMemory ground(vehicle, LaserMount{});
  double x_m = 0.0;
  ground.move_to({x_m, 0.0, 0.0});
  for (int i = 0; i < 1000 && ground.known_m({-0.05, 0.0}, 0.01) > 0.0; ++i) {
    x_m -= 0.002;
    ground.move_to({x_m, 0.0, 0.0});
  }
  EXPECT_GT(x_m, -0.15);  // a cell and the tolerance of the outline
}

TEST(Guard, AcceptsABlindRangeThatEqualsTheMargin) {
  GuardParams params = groundhog_guard();
  params.vehicle.length_m = 0.9;
  params.lasers.front.T_body_laser.x = 0.4;  // 0.4 + 0.2 - 0.45 is 0.15, and a rounding error
  params.lasers.rear.T_body_laser.x = -0.4;
  EXPECT_NO_THROW(Guard{params});
}

TEST(Guard, StatesTheNumbersOfABlindRangeThatIsTooLong) {
  GuardParams params = groundhog_guard();
  params.lasers.front.T_body_laser.x = 1.2;
  try {
    const Guard guard{params};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("1.200 + 0.200 - 1.200 = 0.200 m"));
  }
}

}  // namespace
}  // namespace adit
