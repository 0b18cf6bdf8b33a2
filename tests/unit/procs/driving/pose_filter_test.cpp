// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pose_filter.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriod = 26'667;

std::int64_t nth(int i) { return kStart + i * kPeriod; }
/// The pose at 0.4 m/s on a circle of 2.5 m.
Pose2 truth(std::int64_t utime) {
  const double distance_m = 0.4 * 1e-6 * static_cast<double>(utime - kStart);
  return along_arc(distance_m, 0.4 * distance_m);
}

double distance(const Pose2& a, const Pose2& b) { return between(a, b).translation().norm(); }

TEST(PoseFilter, DoesNotLagBehindTheCommandedMotion) {
  PoseFilter filter(0.3);
  filter.set_motion(0.4, 0.4);
  for (int i = 0; i < 100; ++i) filter.add(nth(i), truth(nth(i)));
  for (const std::int64_t later : {0, 50'000, 100'000}) {
    const std::int64_t utime = nth(99) + later;
    EXPECT_LT(distance(filter.at(utime), truth(utime)), 1e-9);
    EXPECT_NEAR(angle_diff(filter.at(utime).theta, truth(utime).theta), 0.0, 1e-9);
  }
}

TEST(PoseFilter, AttenuatesNoise) {
  PoseFilter filter(0.3);
  filter.set_motion(0.4, 0.4);
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.02);
  double squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 T = truth(nth(i));
    filter.add(nth(i), {T.x + noise(engine), T.y + noise(engine), T.theta});
    if (i >= 100) squares += std::pow(filter.at(nth(i)).y - T.y, 2);
  }
  // g / (2 - g) of the variance, where g = 1 - exp(-26.7 ms / 0.3 s): 0.21 of 2 cm.
  EXPECT_NEAR(std::sqrt(squares / 1900.0), 0.0042, 0.0005);
}

TEST(PoseFilter, AveragesTheFirstPoses) {
  PoseFilter filter(10.0);
  filter.add(nth(0), {0.0, 0.0, 0.0});
  filter.add(nth(1), {0.3, 0.0, 0.0});
  EXPECT_NEAR(filter.at(nth(1)).x, 0.15, 1e-12);
}

TEST(PoseFilter, ResetsAfterAJumpOrAGap) {
  PoseFilter filter(10.0);
  filter.add(nth(0), {});
  filter.add(nth(1), {3.0, 0.0, 0.0});
  EXPECT_EQ(filter.at(nth(1)), (Pose2{3.0, 0.0, 0.0}));
  filter.add(nth(50), {3.2, 0.0, 0.0});
  EXPECT_EQ(filter.at(nth(50)), (Pose2{3.2, 0.0, 0.0}));
}

TEST(PoseFilter, IgnoresLatePosesAndResetsAfterAStepBackInTime) {
  PoseFilter filter(0.3);
  EXPECT_FALSE(filter.utime());
  filter.add(nth(50), {});
  filter.add(nth(48), {0.2, 0.0, 0.0});
  EXPECT_EQ(filter.utime(), nth(50));
  EXPECT_EQ(filter.at(nth(50)).x, 0.0);
  filter.add(nth(0), {0.2, 0.0, 0.0});
  EXPECT_EQ(filter.utime(), nth(0));
  EXPECT_EQ(filter.at(nth(0)).x, 0.2);
}

}  // namespace
}  // namespace adit
