// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/vehicle/drivetrain.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kStepS = 0.01;
constexpr double kExact = 1e-9;
constexpr std::int64_t kStart = 1'000'000;

struct Driven {
  double distance_m = 0.0;
  double seconds = 0.0;
};

class DrivetrainTest : public testing::Test {
 protected:
  void send_command(double speed_m_s, double curvature_1_m = 0.0) {
    drivetrain_.command(DriveCommand{drivetrain_.utime(), speed_m_s, curvature_1_m});
  }
  void order(bool stopped, std::int64_t utime) {
    drivetrain_.command(StopOrder{utime, stopped, stopped ? "test" : ""});
  }
  /// With a fresh command at each step.
  double drive(double speed_m_s, double curvature_1_m, double seconds) {
    double distance_m = 0.0;
    for (int i = 0; i < std::lround(seconds / kStepS); ++i) {
      send_command(speed_m_s, curvature_1_m);
      drivetrain_.advance(kStepS);
      distance_m += drivetrain_.wheel_distance_m();
    }
    return distance_m;
  }
  /// Without any, until it stands.
  Driven coast() {
    Driven driven;
    while (drivetrain_.speed_m_s() != 0.0) {
      drivetrain_.advance(kStepS);
      driven.distance_m += drivetrain_.wheel_distance_m();
      driven.seconds += kStepS;
    }
    return driven;
  }

  Vehicle vehicle_;  // at most 0.5 m/s, at least 1.6 m of radius
  VehicleModelParams params_;
  Drivetrain drivetrain_{vehicle_, params_, kStart};
};

TEST_F(DrivetrainTest, AcceleratesAtItsRate) {
  const double distance_m = drive(0.4, 0.0, 1.0);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.3, kExact);
  EXPECT_NEAR(distance_m, 0.5 * 0.3, kExact);
  drive(0.4, 0.0, 1.0);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.4, kExact);
}

TEST_F(DrivetrainTest, BrakesToASlowerSpeedAndThroughAChangeOfDirection) {
  drive(0.4, 0.0, 3.0);
  drive(0.2, 0.0, 0.1);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.4 - 0.1 * 0.8, kExact);
  drive(0.2, 0.0, 1.0);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.2, kExact);
  drive(-0.3, 0.0, 0.5);  // a quarter of a second to brake, then acceleration
  EXPECT_NEAR(drivetrain_.speed_m_s(), -0.25 * 0.3, kExact);
}

TEST_F(DrivetrainTest, SteersAtItsRateAlsoAtRest) {
  drive(0.0, 0.4, 0.5);
  EXPECT_NEAR(drivetrain_.curvature_1_m(), 0.25, kExact);
  drive(0.0, 0.4, 0.5);
  EXPECT_NEAR(drivetrain_.curvature_1_m(), 0.4, kExact);
}

TEST_F(DrivetrainTest, ClampsCommandsToItsLimits) {
  drive(3.0, -7.0, 5.0);
  EXPECT_NEAR(drivetrain_.speed_m_s(), vehicle_.speed_max_m_s, kExact);
  EXPECT_NEAR(drivetrain_.curvature_1_m(), -1.0 / vehicle_.turning_radius_m, kExact);
}

TEST_F(DrivetrainTest, IgnoresCommandsThatAreNotFiniteOrOutdated) {
  drive(0.4, 0.0, 2.0);
  send_command(0.4);
  send_command(std::numeric_limits<double>::quiet_NaN());
  send_command(0.4, std::numeric_limits<double>::infinity());
  drivetrain_.command(DriveCommand{drivetrain_.utime() - 1, 0.1, 0.0});
  drivetrain_.advance(kStepS);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.4, kExact);
}

TEST_F(DrivetrainTest, StandsUntilACommand) {
  drivetrain_.advance(kStepS);
  EXPECT_EQ(drivetrain_.speed_m_s(), 0.0);
  EXPECT_TRUE(drivetrain_.expired());
  send_command(0.1);
  EXPECT_FALSE(drivetrain_.expired());
}

TEST_F(DrivetrainTest, BrakesAfterAQuarterOfASecondWithoutCommand) {
  drive(0.4, 0.0, 2.0);
  send_command(0.4);
  const Driven driven = coast();
  EXPECT_TRUE(drivetrain_.expired());
  EXPECT_NEAR(driven.distance_m, 0.4 * 0.25 + 0.4 * 0.4 / (2.0 * 0.8), kExact);
  EXPECT_NEAR(driven.seconds, 0.25 + 0.4 / 0.8, kExact);
}

TEST_F(DrivetrainTest, TreatsACommandFromTheFutureAsCurrent) {
  drive(0.4, 0.0, 2.0);
  drivetrain_.command(DriveCommand{drivetrain_.utime() + 60'000'000, 0.4, 0.0});
  EXPECT_NEAR(coast().seconds, 0.25 + 0.4 / 0.8, kExact);
  drive(0.4, 0.0, 0.5);  // and later commands still count
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.15, kExact);
}

TEST_F(DrivetrainTest, HoldsAStopUntilANewerOrderReleasesIt) {
  drive(0.4, 0.0, 2.0);
  const std::int64_t stop_utime = drivetrain_.utime();
  order(true, stop_utime);
  const double distance_m = drive(0.4, 0.0, 1.0);
  EXPECT_NEAR(distance_m, 0.4 * 0.4 / (2.0 * 0.8), kExact);
  EXPECT_EQ(drivetrain_.speed_m_s(), 0.0);
  EXPECT_TRUE(drivetrain_.stopped());
  order(false, stop_utime - 1);
  order(false, stop_utime);
  EXPECT_TRUE(drivetrain_.stopped());
  order(false, stop_utime + 1);
  EXPECT_FALSE(drivetrain_.stopped());
  drive(0.4, 0.0, 0.5);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.15, kExact);
}

TEST_F(DrivetrainTest, ObeysAStopOrderOfAClockThatJumpedBack) {
  drive(0.4, 0.0, 2.0);
  order(false, drivetrain_.utime());
  order(true, drivetrain_.utime() - 5'000'000);
  EXPECT_TRUE(drivetrain_.stopped());
  order(false, drivetrain_.utime() - 4'000'000);  // which may be from before the stop
  EXPECT_TRUE(drivetrain_.stopped());
  drivetrain_.advance(kStepS);
  order(false, drivetrain_.utime());
  EXPECT_FALSE(drivetrain_.stopped());
}

TEST_F(DrivetrainTest, StandsWhenStopOrdersTimeOut) {
  drive(0.4, 0.0, 2.0);
  EXPECT_FALSE(drivetrain_.stopped());  // none ever came
  for (int i = 0; i < 20; ++i) {
    order(false, drivetrain_.utime());
    drive(0.4, 0.0, 0.1);
  }
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.4, kExact);
  drive(0.4, 0.0, 0.39);
  EXPECT_FALSE(drivetrain_.stopped());
  drive(0.4, 0.0, 0.01);  // half a second after the last
  EXPECT_TRUE(drivetrain_.stopped());
  drive(0.4, 0.0, 0.5);
  EXPECT_EQ(drivetrain_.speed_m_s(), 0.0);
  order(false, drivetrain_.utime());
  EXPECT_FALSE(drivetrain_.stopped());
  drive(0.4, 0.0, 0.1);
  EXPECT_NEAR(drivetrain_.speed_m_s(), 0.03, kExact);
}

TEST_F(DrivetrainTest, IgnoresOutdatedReleases) {
  drive(0.4, 0.0, 2.0);
  order(false, drivetrain_.utime());
  for (int i = 0; i < 10; ++i) {  // of a clock that went back
    drive(0.4, 0.0, 0.1);
    order(false, kStart);
  }
  EXPECT_TRUE(drivetrain_.stopped());
  EXPECT_EQ(drivetrain_.speed_m_s(), 0.0);
}

TEST_F(DrivetrainTest, StandsUnderADriverWhoseClockJumpedBack) {
  drive(0.4, 0.0, 2.0);
  for (int i = 0; i < 300; ++i) {
    drivetrain_.command(DriveCommand{drivetrain_.utime() - 2'000'000, 0.4, 0.0});
    drivetrain_.advance(kStepS);
  }
  EXPECT_TRUE(drivetrain_.expired());
  EXPECT_EQ(drivetrain_.speed_m_s(), 0.0);
}

constexpr double kCapacityWh = 10000.0;
constexpr double kHourS = 3600.0;
constexpr double kIdleW = 200.0;
constexpr double kWeightN = 680.0 * 9.81;
constexpr double kEfficiency = 0.5;
constexpr double kRolling = 0.15;

/// Mean power drawn over an hour [W].
double drawn_w(double speed_m_s, double rise) {
  VehicleModelParams params;
  params.battery_wh = kCapacityWh;
  Battery battery({}, params);
  battery.draw(speed_m_s, rise, kHourS);
  return (1.0 - battery.share()) * kCapacityWh;
}

TEST(Battery, DrawsIdlePowerAtRest) {
  EXPECT_NEAR(drawn_w(0.0, 0.0), kIdleW, kExact);
  EXPECT_NEAR(drawn_w(0.0, 0.3), kIdleW, kExact);  // the brakes hold it
}

TEST(Battery, DrawsAgainstRollingResistanceOnLevelGround) {
  const double expected = kIdleW + kWeightN * kRolling * 0.4 / kEfficiency;
  EXPECT_NEAR(drawn_w(0.4, 0.0), expected, kExact);
  EXPECT_NEAR(drawn_w(-0.4, 0.0), expected, kExact);
}

TEST(Battery, DrawsPowerUphillInEitherDirection) {
  const double rise = std::sin(0.2);
  const double expected = kIdleW + kWeightN * (kRolling * std::cos(0.2) + rise) * 0.4 / kEfficiency;
  EXPECT_NEAR(drawn_w(0.4, rise), expected, kExact);
  EXPECT_NEAR(drawn_w(-0.4, -rise), expected, kExact);
}

TEST(Battery, RecuperatesNothingDownhill) {
  EXPECT_NEAR(drawn_w(0.4, -0.3), kIdleW, kExact);  // steeper than it rolls by itself
  const double rise = -0.05;
  const double left = kRolling * std::sqrt(1.0 - rise * rise) + rise;
  EXPECT_NEAR(drawn_w(0.4, rise), kIdleW + kWeightN * left * 0.4 / kEfficiency, kExact);
}

TEST(Battery, IsEmptyWhenItsEnergyIsDrawn) {
  VehicleModelParams params;
  params.battery_wh = kIdleW;
  Battery battery({}, params);
  battery.draw(0.0, 0.0, 0.75 * kHourS);
  EXPECT_NEAR(battery.share(), 0.25, kExact);
  EXPECT_FALSE(battery.empty());
  battery.draw(0.0, 0.0, kHourS);
  EXPECT_EQ(battery.share(), 0.0);
  EXPECT_TRUE(battery.empty());
}

}  // namespace
}  // namespace adit
