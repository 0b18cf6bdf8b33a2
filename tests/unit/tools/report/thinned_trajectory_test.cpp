// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/thinned_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kThinnedStart = 1'600'000'000'000'000;
constexpr double kSpeedM_s = 0.5;
constexpr double kBrakingM_s2 = 0.8;
constexpr double kBrakesS = 2.01;

/// A body that drives along x, brakes, and stands.
TimedPose at(double t) {
  const double braked_s = std::clamp(t - kBrakesS, 0.0, kSpeedM_s / kBrakingM_s2);
  const double x =
      kSpeedM_s * (std::min(t, kBrakesS) + braked_s) - 0.5 * kBrakingM_s2 * braked_s * braked_s;
  return {kThinnedStart + std::llround(1e6 * t), {x, 0.0, 0.0}, 0.0};
}

ThinnedTrajectory thinned(double tolerance_m) {
  ThinnedTrajectory trajectory(tolerance_m);
  for (int i = 0; i <= 500; ++i) trajectory.add(at(0.02 * i));
  return trajectory;
}

double largest_error_m(const Trajectory& poses) {
  double largest = 0.0;
  for (int i = 0; i <= 500; ++i) {
    const TimedPose real = at(0.02 * i);
    const auto found = interpolate(poses, real.utime);
    largest = std::max(largest, found ? std::abs(found->x - real.pose.x) : 1.0);
  }
  return largest;
}

TEST(ThinnedTrajectory, IsAccurateWhereTheBodyStops) {
  constexpr double kTolerance = 0.001;
  const Trajectory poses = thinned(kTolerance).poses();
  EXPECT_LE(largest_error_m(poses), kTolerance + 1e-9);
  EXPECT_LT(poses.size(), 60U);
  EXPECT_GT(largest_error_m(thinned(std::numeric_limits<double>::infinity()).poses()), 0.01);
}

TEST(ThinnedTrajectory, KeepsTheLastPoseAndIgnoresOlderOnes) {
  ThinnedTrajectory trajectory(0.001);
  for (const double t : {0.0, 0.02, 0.04, 0.03}) trajectory.add(at(t));
  EXPECT_EQ(trajectory.poses().back(), at(0.04));
}

}  // namespace
}  // namespace adit
