// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/laser/tilt_actuator.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kStep = 0.01;

/// Runs for a time and checks the limits of rate and acceleration and the goal.
void run(TiltActuator& tilt, double seconds, double goal_rad, double rate_max_rad_s) {
  const TiltParams params;
  const double side = goal_rad - tilt.angle_rad();
  for (int i = 0; i < std::lround(seconds / kStep); ++i) {
    const double angle = tilt.angle_rad();
    const double rate = tilt.rate_rad_s();
    tilt.advance(kStep);
    EXPECT_LE(std::abs(tilt.rate_rad_s()), rate_max_rad_s + 1e-12);
    const double change = std::abs(tilt.rate_rad_s() - rate);
    EXPECT_LE(change, params.acceleration_rad_s2 * kStep + 1e-12);
    // The mean rate lies between the rates, but for the corner of a trapezoid in the step.
    const double mean = (rate + tilt.rate_rad_s()) / 2.0;
    EXPECT_NEAR((tilt.angle_rad() - angle) / kStep, mean, change / 2.0 + 1e-9);
    EXPECT_GE((goal_rad - tilt.angle_rad()) * side, -1e-12) << "beyond the goal";
  }
}

TEST(TiltActuator, FollowsATrapezoidalRateProfileAndHoldsTheGoal) {
  TiltActuator tilt({});
  tilt.command({0, 0.4, 0.5});
  run(tilt, 1.04, 0.4, 0.5);
  EXPECT_LT(tilt.angle_rad(), 0.4);
  run(tilt, 0.02, 0.4, 0.5);  // 0.4 / 0.5 + 0.5 / 2 = 1.05 s
  EXPECT_EQ(tilt.angle_rad(), 0.4);
  EXPECT_EQ(tilt.rate_rad_s(), 0.0);
  tilt.advance(5.0);
  EXPECT_EQ(tilt.angle_rad(), 0.4);
}

TEST(TiltActuator, AShortMotionHasATriangularRateProfile) {
  TiltActuator tilt({});
  tilt.command({0, -0.02, 0.5});
  run(tilt, 0.1, -0.02, 0.5);  // half of 2 √(0.02 / 2) = 0.2 s
  EXPECT_NEAR(tilt.angle_rad(), -0.01, 1e-12);
  EXPECT_NEAR(tilt.rate_rad_s(), -0.2, 1e-12);
  run(tilt, 0.11, -0.02, 0.5);
  EXPECT_EQ(tilt.angle_rad(), -0.02);
}

TEST(TiltActuator, KeepsTheRateLimitsOfCommandAndMotor) {
  TiltActuator slow({});
  slow.command({0, 0.4, 0.1});
  run(slow, 4.2, 0.4, 0.1);
  EXPECT_EQ(slow.angle_rad(), 0.4);
  TiltActuator fast({});
  fast.command({0, 0.4, 100.0});
  run(fast, 1.06, 0.4, 0.5);
  EXPECT_EQ(fast.angle_rad(), 0.4);
}

TEST(TiltActuator, ReversesDuringAMotion) {
  TiltActuator tilt({});
  tilt.command({0, 0.4, 0.5});
  tilt.advance(0.5);
  tilt.command({0, -0.4, 0.5});
  const double turned_at = tilt.angle_rad();
  double greatest = turned_at;
  for (int i = 0; i < 300; ++i) {
    tilt.advance(kStep);
    greatest = std::max(greatest, tilt.angle_rad());
  }
  EXPECT_NEAR(greatest, turned_at + 0.5 * 0.5 / (2.0 * 2.0), 1e-3);  // v² / 2a, seen each 10 ms
  EXPECT_EQ(tilt.angle_rad(), -0.4);
}

TEST(TiltActuator, SlowsDownForASlowerCommand) {
  TiltActuator tilt({});
  tilt.command({0, 0.4, 0.5});
  tilt.advance(0.3);
  tilt.command({0, 0.4, 0.1});
  tilt.advance(0.2);  // (0.5 − 0.1) / 2
  EXPECT_NEAR(tilt.rate_rad_s(), 0.1, 1e-12);
  run(tilt, 4.0, 0.4, 0.1);
  EXPECT_EQ(tilt.angle_rad(), 0.4);
}

TEST(TiltActuator, StaysWithinItsAngles) {
  TiltActuator tilt({});
  tilt.command({0, 2.0, 0.5});
  tilt.advance(10.0);
  EXPECT_EQ(tilt.angle_rad(), 0.524);
  tilt.command({0, -2.0, 0.5});
  tilt.advance(10.0);
  EXPECT_EQ(tilt.angle_rad(), -0.524);
}

TEST(TiltActuator, IgnoresInvalidCommands) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const TiltCommand& odd :
       {TiltCommand{0, kNaN, 0.5}, TiltCommand{0, 0.1, kNaN}, TiltCommand{0, kInf, 0.5},
        TiltCommand{0, 0.1, 0.0}, TiltCommand{0, 0.1, -0.5}}) {
    TiltActuator tilt({});
    tilt.command({0, 0.4, 0.5});
    tilt.advance(0.2);
    tilt.command(odd);
    tilt.advance(2.0);
    EXPECT_EQ(tilt.angle_rad(), 0.4);
  }
}

TEST(TiltActuator, EncoderCountsSteps) {
  TiltParams params;
  params.encoder_step_rad = 0.01;
  TiltActuator tilt(params);
  tilt.command({0, 0.123, 0.5});
  tilt.advance(2.0);
  EXPECT_NEAR(tilt.reading(7).angle_rad, 0.12, 1e-12);
  EXPECT_EQ(tilt.reading(7).utime, 7);
  params.encoder_step_rad = 0.0;
  TiltActuator exact(params);
  exact.command({0, 0.123, 0.5});
  exact.advance(2.0);
  EXPECT_EQ(exact.reading(7).angle_rad, 0.123);
}

}  // namespace
}  // namespace adit
