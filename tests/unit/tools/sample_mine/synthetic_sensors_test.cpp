// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "tools/sample_mine/mine_worlds.hpp"
#include "tools/sample_mine/synthetic_laser.hpp"
#include "tools/sample_mine/synthetic_odometry.hpp"

namespace adit {
namespace {

TEST(SyntheticLaser, MeasuresCounterClockwiseFromTheRight) {
  SyntheticLaserModel model;
  model.noise_sd_m = 0.0;
  const SyntheticWorld world = straight_tunnel(400.0, 4.0);
  const LaserScan scan = SyntheticLaser(model, 1).measure(world, {0.0, 0.5, 0.0}, 77);
  EXPECT_EQ(scan.utime, 77);
  ASSERT_EQ(scan.ranges_m.size(), 181U);
  EXPECT_FLOAT_EQ(scan.ranges_m.front(), 2.5F);
  EXPECT_FLOAT_EQ(scan.ranges_m.back(), 1.5F);
  EXPECT_FLOAT_EQ(scan.ranges_m[90], 81.83F);  // along the drift, open at its end
}

TEST(SyntheticLaser, HasTheNoiseItIsGiven) {
  SyntheticLaserModel model;
  model.noise_sd_m = 0.05;
  SyntheticLaser laser(model, 1);
  const SyntheticWorld world = straight_tunnel(400.0, 4.0);
  double squares = 0.0;
  const int count = 2000;
  for (int i = 0; i < count; ++i) {
    const double error = laser.measure(world, {}, 0).ranges_m.front() - 2.0;
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.003);  // four standard errors
}

TEST(SyntheticLaser, MayLookInOtherDirectionsThanItReports) {
  SyntheticLaserModel model;
  model.noise_sd_m = 0.0;
  model.bearing_scale = 0.5;
  const LaserScan scan = SyntheticLaser(model, 1).measure(straight_tunnel(400.0, 4.0), {}, 0);
  EXPECT_FLOAT_EQ(static_cast<float>(scan.angle_min_rad), -1.5707963F);
  EXPECT_FLOAT_EQ(scan.ranges_m.back(), 2.83F);  // at 45 degrees
}

TEST(SyntheticLaser, TheSameSeedGivesTheSameScans) {
  const SyntheticWorld world = sample_mine(1);
  SyntheticLaser a(half_degree_laser(), 5);
  SyntheticLaser b(half_degree_laser(), 5);
  SyntheticLaser c(half_degree_laser(), 6);
  const LaserScan scan = a.measure(world, {10.0, 0.0, 0.0}, 0);
  EXPECT_EQ(scan.ranges_m.size(), 361U);
  EXPECT_EQ(scan, b.measure(world, {10.0, 0.0, 0.0}, 0));
  EXPECT_NE(scan, c.measure(world, {10.0, 0.0, 0.0}, 0));
}

TEST(SyntheticOdometry, WithoutErrorsIsTheTruth) {
  SyntheticOdometry odometry({1.0, 1.0, 0.0, 0.0, 0.0, 0.0}, 1);
  const Pose2 step{0.3, 0.01, 0.1};
  odometry.advance(step, 1);
  EXPECT_EQ(odometry.advance(step, 2).T_wheel_body, step * step);
}

TEST(SyntheticOdometry, DriftsWithTheWay) {
  SyntheticOdometry odometry({}, 1);
  Pose2 reading;
  for (int i = 0; i < 1000; ++i) reading = odometry.advance({0.1, 0.0, 0.0}, i).T_wheel_body;
  const double error = (reading.translation() - Eigen::Vector2d(100.0, 0.0)).norm();
  EXPECT_GT(error, 0.5);
  EXPECT_LT(error, 20.0);
}

}  // namespace
}  // namespace adit
