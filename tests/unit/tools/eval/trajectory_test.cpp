// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Trajectory, InterpolatesByTheShortestRotation) {
  const Trajectory trajectory{{1'000'000, {0.0, 0.0, deg_to_rad(170.0)}},
                              {3'000'000, {2.0, 4.0, deg_to_rad(-170.0)}}};
  const auto pose = interpolate(trajectory, 1'500'000);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x, 0.5);
  EXPECT_DOUBLE_EQ(pose->y, 1.0);
  EXPECT_NEAR(rad_to_deg(pose->theta), 175.0, 1e-9);
}

TEST(Trajectory, ReturnsItsOwnPoses) {
  const Trajectory trajectory{{10'000, {1, 2, 3}}, {20'000, {4, 5, 1}}, {30'000, {7, 8, 2}}};
  for (const auto& [utime, pose, z_m] : trajectory) {
    EXPECT_EQ(interpolate(trajectory, utime), pose);
  }
}

TEST(Trajectory, HasNoPosesBeyondItsEnds) {
  const Trajectory trajectory{{1'000'000, {1, 0, 0}}, {2'000'000, {2, 0, 0}}};
  EXPECT_FALSE(interpolate(trajectory, 998'000));
  EXPECT_FALSE(interpolate(trajectory, 2'002'000));
  EXPECT_EQ(interpolate(trajectory, 999'990), trajectory.front().pose);
  EXPECT_EQ(interpolate(trajectory, 2'000'010), trajectory.back().pose);
  EXPECT_FALSE(interpolate(Trajectory{}, 0));
}

TEST(Trajectory, MeasuresItsLength) {
  EXPECT_DOUBLE_EQ(path_length_m({{1, {0, 0, 0}}, {2, {3, 4, 0}}, {3, {3, 5, 0}}}), 6.0);
  EXPECT_DOUBLE_EQ(path_length_m({}), 0.0);
}

/// A pose every 13 mm with a uniform error of up to 1 cm in x and y.
Trajectory jittering(double length_m) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> aside(-0.01, 0.01);
  Trajectory trajectory;
  for (int i = 0; i <= std::lround(length_m / 0.013); ++i) {
    trajectory.push_back({i, {0.013 * i + aside(random), aside(random), 0.0}});
  }
  return trajectory;
}

TEST(DistanceTravelled, IsZeroForARobotAtRest) {
  Trajectory trajectory = jittering(50.0);
  for (TimedPose& timed : trajectory) timed.pose.x -= 0.013 * static_cast<double>(timed.utime);
  EXPECT_GT(path_length_m(trajectory), 10.0);
  EXPECT_EQ(distance_travelled_m(trajectory, 0.2), 0.0);
  EXPECT_EQ(distance_travelled_m(Trajectory{}, 0.2), 0.0);
}

TEST(DistanceTravelled, KeepsTheLengthOfAStraightLine) {
  const Trajectory straight{{1, {0, 0, 0}}, {2, {0.25, 0, 0}}, {3, {0.5, 0, 0}}, {4, {4.5, 0, 0}}};
  EXPECT_DOUBLE_EQ(distance_travelled_m(straight, 0.2), 4.5);
  // Up to a step is missing at the end; each of 250 steps is longer by at most 0.02²/(2·0.2)
  // because of lateral errors, and the ends have errors of 1 cm.
  const double measured = distance_travelled_m(jittering(50.0), 0.2);
  EXPECT_LT(measured, 50.0 + 250 * 0.02 * 0.02 / 0.4 + 0.02);
  EXPECT_GT(measured, 50.0 - 0.2 - 0.02 - 0.013);
}

TEST(DistanceTravelled, CountsReversals) {
  const Trajectory there_and_back{{1, {0, 0, 0}}, {2, {2, 0, 0}}, {3, {1.9, 0, 0}}, {4, {0, 0, 0}}};
  EXPECT_DOUBLE_EQ(distance_travelled_m(there_and_back, 0.2), 4.0);
}

}  // namespace
}  // namespace adit
