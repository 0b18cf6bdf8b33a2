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
    points.p_body_free.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle));
  }
  ground.observe(points);
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 1.0), 1.0);
  // The corners of the body, (-0.4, ±0.3), reach the circle after 1.98 - 0.4 m.
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 3.0), 1.58, 0.15);  // a cell and a half
}

/// Drives along x in steps of 0.1 m, a number of steps to a side of the present place.
class Drive {
 public:
  explicit Drive(BlindSideMemory& ground) : ground_(ground) { ground_.move_to(pose()); }
  void by(int steps, bool with_corrections = false) {
    for (int i = 0; i < std::abs(steps); ++i) {
      step_ += steps > 0 ? 1 : -1;
      ground_.move_to(pose());
      if (with_corrections && i % 10 == 0) ground_.correct(correction);
    }
  }
  MapCorrection correction;

 private:
  [[nodiscard]] Pose2 pose() const { return {0.1 * step_, 0.0, 0.0}; }
  BlindSideMemory& ground_;
  int step_ = 0;
};

TEST(BlindSideMemory, KnowsThePathOfTheLast60Metres) {
  BlindSideMemory ground(Vehicle{}, LaserMount{});
  Drive drive(ground);
  drive.by(400);
  drive.by(-240);  // at x = 16 m, 64 m driven: known from x = 4 m on
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 5.5), 5.5);
  drive.by(
      -50);  // at x = 11 m, 69 m driven: known from x = 9 m on, less half a vehicle and a sample
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 6.0), 2.0, 0.1);
  EXPECT_EQ(ground.known_m({0.3, 0.0}, 6.0), 6.0);  // driven twice
}

TEST(BlindSideMemory, KnowsAllOfThePathWithAMap) {
  BlindSideMemory ground(Vehicle{}, LaserMount{});
  Drive drive(ground);
  drive.by(800, true);
  drive.by(-750, true);                                     // at x = 5 m
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 6.0), 5.0, 0.1);  // to the start
}

TEST(BlindSideMemory, ForgetsWithoutAMapFor60Metres) {
  BlindSideMemory ground(Vehicle{}, LaserMount{});
  Drive drive(ground);
  drive.by(200, true);
  drive.by(400);
  drive.by(-450);  // at x = 15 m, the last correction 85 m ago: only what it drives now
  EXPECT_LT(ground.known_m({-0.3, 0.0}, 1.0), 0.1);
}

/// A robot that backs out of a tunnel leaves its tracks a little.
TEST(BlindSideMemory, KnowsWhatItSawBesideThePathWhenItComesBack) {
  BlindSideMemory ground(Vehicle{}, LaserMount{});
  const auto move = [&](int steps, double y_m) {
    ground.move_to({0.1 * steps, y_m, 0.0});
    LaserPoints walls;  // 2 m to each side, seen ahead only
    for (int i = 1; i < 90; ++i) {
      const double x = 2.0 / std::tan(std::numbers::pi * i / 180.0);
      walls.p_body_free.emplace_back(x, -2.0);
      walls.p_body_free.emplace_back(x, 2.0);
    }
    ground.observe(walls);
  };
  for (int i = 0; i <= 300; ++i) move(i, 0.0);
  for (int i = 300; i >= 50; --i) move(i, 0.3);
  EXPECT_EQ(ground.known_m({-0.3, 0.0}, 2.0), 2.0);
}

/// What was driven more than 10 m ago keeps its place in map where odom moves in it.
TEST(BlindSideMemory, MovesWithTheMap) {
  BlindSideMemory ground(Vehicle{}, LaserMount{});
  Drive drive(ground);
  drive.by(200, true);
  drive.correction.T_map_odom = {0.0, 0.2, 0.0};
  ground.correct(drive.correction);
  // The older part lies 0.2 m to the right in odom: a vehicle that keeps straight leaves it.
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 5.0), 5.0, 1e-9);
  drive.by(-60);
  EXPECT_NEAR(ground.known_m({-0.3, 0.0}, 5.0), 4.0, 0.15);
}

TEST(BlindSideMemory, ForgetsWhatALargeCorrectionOrAnotherOdomFrameMoves) {
  for (const bool is_large : {true, false}) {
    BlindSideMemory ground(Vehicle{}, LaserMount{});
    Drive drive(ground);
    drive.by(200, true);
    drive.by(-80);
    EXPECT_EQ(ground.known_m({-0.3, 0.0}, 5.0), 5.0);
    drive.correction.T_map_odom = {is_large ? 0.4 : 0.01, 0.0, 0.0};
    drive.correction.session = is_large ? 0 : 1;
    ground.correct(drive.correction);  // 28 m driven: what was driven up to 18 m is forgotten
    EXPECT_EQ(ground.known_m({0.3, 0.0}, 5.0), 5.0);
    EXPECT_LT(ground.known_m({-0.3, 0.0}, 5.0), 0.1) << is_large;
  }
}

/// In a tunnel with a recess every 3 m, 4 m to one side and 2 m to the other, driven along and
/// back: a correction along the tunnel of 0.6 m and of a whole recess, right or wrong.
TEST(BlindSideMemory, KnowsTheGroundAfterALargeCorrectionThatAScanConfirms) {
  const auto scan_at = [](double x_m) {
    LaserPoints points;
    for (int i = 0; i < 270; ++i) {
      const double angle = (i - 134.5) * std::numbers::pi / 180.0;
      const Eigen::Vector2d ahead(std::cos(angle), std::sin(angle));
      double range_m = 0.0;
      const auto is_free = [&](const Eigen::Vector2d& p) {
        const double along = x_m + p.x() - 3.0 * std::floor((x_m + p.x()) / 3.0);
        return std::abs(p.y()) < 0.8 || (along < 1.0 && p.y() > -2.0 && p.y() < 4.0);
      };
      while (range_m < 5.0 && is_free((range_m + 0.02) * ahead)) range_m += 0.02;
      points.p_body_free.push_back(range_m * ahead);
    }
    return points;
  };
  struct Case {
    double correction_m;  ///< what mapping says
    double drift_m;       ///< of odom, in truth
    bool knows;
  };
  for (const Case& c : {Case{0.6, 0.6, true}, Case{1.0, 1.0, true}, Case{0.6, 0.0, false},
                        Case{-0.9, 0.0, false}, Case{1.6, 1.6, false}}) {
    BlindSideMemory ground(Vehicle{}, LaserMount{});
    MapCorrection correction;
    const auto move = [&](double x_m, double drift_m) {
      ground.move_to({x_m - drift_m, 0.0, 0.0});
      ground.observe(scan_at(x_m));
      ground.correct(correction);
    };
    for (double x_m = 0.0; x_m <= 30.0; x_m += 0.1) move(x_m, 0.0);
    for (double x_m = 30.0; x_m >= 12.0; x_m -= 0.1) move(x_m, c.drift_m * (30.0 - x_m) / 18.0);
    correction.T_map_odom.x = c.correction_m;
    for (double x_m = 12.0; x_m >= 11.0; x_m -= 0.1) move(x_m, c.drift_m);
    EXPECT_EQ(ground.known_m({-0.3, 0.0}, 5.0) >= 4.9, c.knows)
        << c.correction_m << " " << c.drift_m << ": " << ground.known_m({-0.3, 0.0}, 5.0);
  }
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
