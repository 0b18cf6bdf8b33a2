// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/speed_control.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "procs/driving/path_run.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

constexpr double kRate = 0.4;

PathRun run_of(const PlannedPath& path) {
  return blended(split_into_runs(path.points, SteeredPoint({})).front(), 0.5, 0.5, 0.15);
}

TEST(SpeedProfile, NeverExceedsItsLimits) {
  const SpeedParams params;
  for (const PathShape& shape : path_shapes({}, 1.6)) {
    SCOPED_TRACE(shape.name);
    const PathRun run = run_of(shape.path);
    const SpeedProfile profile(run, params, 0.5, kRate);
    double last = profile.at(0.0);
    constexpr double kStepM = 0.01;
    for (double s_m = 0.1; s_m < run.length_m() - 0.1; s_m += kStepM) {
      const double v = profile.at(s_m);
      const double curvature = run.curvature_1_m(s_m - 0.05, s_m + 0.05);
      const double change =
          (run.curvature_1_m(s_m, s_m + 0.1) - run.curvature_1_m(s_m - 0.1, s_m)) / 0.1;
      ASSERT_LE(v, params.speed_m_s);
      ASSERT_GE(v, params.creep_m_s);
      ASSERT_LE(v * v * std::abs(curvature), 1.02 * params.lateral_acceleration_m_s2);  // sampling
      ASSERT_LE(v * std::abs(change), 1.02 * kRate);  // of which it takes 80 % at its samples
      if (s_m > 0.1) {
        ASSERT_LE((last * last - v * v) / (2.0 * kStepM), params.braking_m_s2 + 1e-9);
      }
      last = v;
    }
    EXPECT_EQ(profile.at(run.length_m()), 0.0);
    EXPECT_EQ(profile.at(run.length_m() + 1.0), 0.0);
  }
}

TEST(SpeedProfile, BrakesToTheEndWithConstantDeceleration) {
  const PathRun run = run_of(TestPathBuilder({}).forward(5.0).path());
  const SpeedParams params;
  const SpeedProfile profile(run, params, 0.5, kRate);
  EXPECT_DOUBLE_EQ(profile.at(1.0), params.speed_m_s);
  for (const double remaining : {0.2, 0.1, 0.05}) {
    EXPECT_NEAR(profile.at(5.0 - remaining), std::sqrt(2.0 * params.braking_m_s2 * remaining),
                1e-9);
  }
}

TEST(SpeedProfile, SlowsDownBesideObstacles) {
  PlannedPath path = TestPathBuilder({}).forward(5.0).path();
  for (PathPoint& point : path.points) point.clearance_m = 0.06;
  EXPECT_NEAR(SpeedProfile(run_of(path), {}, 0.5, kRate).at(2.0), 0.125, 1e-9);
  for (PathPoint& point : path.points) point.clearance_m = 0.0;
  EXPECT_NEAR(SpeedProfile(run_of(path), {}, 0.5, kRate).at(2.0), 0.05, 1e-9);
}

TEST(SpeedProfile, KeepsTheMaximumSpeedOfTheVehicle) {
  const PathRun run = run_of(TestPathBuilder({}).forward(5.0).path());
  EXPECT_DOUBLE_EQ(SpeedProfile(run, {}, 0.3, kRate).at(2.0), 0.3);
  EXPECT_DOUBLE_EQ(SpeedProfile(run, {}, 0.03, kRate).at(2.0), 0.03);
}

constexpr double kTickS = 0.05;

class CommandRampTest : public testing::Test {
 protected:
  void stop(int ticks) {
    for (int i = 0; i < ticks; ++i) ramp_.stop(kTickS);
  }
  void drive(double speed_m_s, double curvature_1_m, int ticks) {
    for (int i = 0; i < ticks; ++i) ramp_.drive(speed_m_s, curvature_1_m, kTickS);
  }

  CommandRamp ramp_{0.2, 0.4};
};

TEST_F(CommandRampTest, LimitsTheAccelerationAndSlowsDownImmediately) {
  stop(10);
  drive(0.3, 0.0, 10);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.1, 1e-9);
  drive(0.3, 0.0, 30);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.3, 1e-9);
  drive(0.1, 0.0, 1);
  EXPECT_NEAR(ramp_.speed_m_s(), 0.1, 1e-9);
  drive(0.1, 0.5, 5);
  EXPECT_NEAR(ramp_.curvature_1_m(), 0.1, 1e-9);
}

TEST_F(CommandRampTest, StartsAfterAPauseAndWithTheCurvatureNearlySet) {
  stop(10);
  drive(0.3, 0.6, 19);  // 0.95 s: 0.38 1/m
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  double heading_rad = 0.0;  // that the vehicle turns less than with the curvature set
  for (int i = 0; i < 12; ++i) {
    drive(0.3, 0.6, 1);
    heading_rad += (0.6 - ramp_.curvature_1_m()) * ramp_.speed_m_s() * kTickS;
  }
  EXPECT_GT(ramp_.speed_m_s(), 0.0);
  EXPECT_NEAR(ramp_.curvature_1_m(), 0.6, 1e-9);
  EXPECT_LT(heading_rad, 0.003);  // 0.2°
  stop(2);
  drive(0.3, 0.6, 1);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
}

TEST_F(CommandRampTest, StopsBeforeAChangeOfDirection) {
  stop(10);
  drive(-0.3, 0.0, 20);
  EXPECT_NEAR(ramp_.speed_m_s(), -0.2, 1e-9);
  drive(0.3, 0.0, 1);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  EXPECT_FALSE(ramp_.has_stopped());
  drive(0.3, 0.0, 6);
  EXPECT_EQ(ramp_.speed_m_s(), 0.0);
  drive(0.3, 0.0, 2);
  EXPECT_GT(ramp_.speed_m_s(), 0.0);
}

}  // namespace
}  // namespace adit
