// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/goals/connecting_curve.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kRadiusMinM = 0.5;
constexpr double kPoseSpacingMaxM = 0.1;

/// Each step is nearly on an arc that the vehicle can drive, in the direction of the whole.
TEST(ConnectingCurve, IsDrivable) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  std::uniform_real_distribution<double> beside(-0.5, 0.5);
  std::uniform_real_distribution<double> angle(-1.0, 1.0);
  int found = 0;
  for (int round = 0; round < 500; ++round) {
    const Pose2 from{place(random), place(random), 3.0 * angle(random)};
    const Pose2 to = from * Pose2{place(random), beside(random), angle(random)};
    const auto path = connecting_curve(from, to, kRadiusMinM, kPoseSpacingMaxM);
    if (path.empty()) continue;
    ++found;
    EXPECT_EQ(path.back(), to);
    const double direction = between(from, to).x < 0.0 ? -1.0 : 1.0;
    Pose2 before = from;
    for (const Pose2& pose : path) {
      const Pose2 step = between(before, pose);
      const double step_m = step.translation().norm();
      EXPECT_GT(direction * step.x, 0.0);
      EXPECT_LE(step_m, 2.0 * kPoseSpacingMaxM);
      EXPECT_LE(std::abs(step.theta), 1.1 * step_m / kRadiusMinM + 1e-3);
      const Pose2 along_chord{0.0, 0.0, 0.5 * step.theta};
      EXPECT_NEAR((along_chord.inverse() * step.translation()).y(), 0.0, 0.005);
      before = pose;
    }
  }
  EXPECT_GT(found, 150);
}

TEST(ConnectingCurve, IsStraightOnALine) {
  for (const double x : {-1.0, 1.0}) {
    const auto path = connecting_curve({0, 0, 0}, {x, 0, 0}, kRadiusMinM, kPoseSpacingMaxM);
    ASSERT_EQ(path.size(), 10U);
    for (const Pose2& pose : path) {
      EXPECT_NEAR(pose.y, 0.0, 1e-12);
      EXPECT_NEAR(pose.theta, 0.0, 1e-12);
    }
  }
}

/// A shift by d over a length L needs a curvature of 6 d / L² (the ends of the cubic).
TEST(ConnectingCurve, NeedsTheLengthOfAShift) {
  const double shift_m = 0.25;
  const double length_m = std::sqrt(6.0 * shift_m * kRadiusMinM);
  EXPECT_TRUE(connecting_curve({0, 0, 0}, {0.9 * length_m, shift_m, 0}, kRadiusMinM, 0.1).empty());
  EXPECT_FALSE(connecting_curve({0, 0, 0}, {1.1 * length_m, shift_m, 0}, kRadiusMinM, 0.1).empty());
}

TEST(ConnectingCurve, IsNoneForATurnOnTheSpot) {
  EXPECT_TRUE(connecting_curve({0, 0, 0}, {0, 0, 0}, kRadiusMinM, 0.1).empty());
  EXPECT_TRUE(connecting_curve({0, 0, 0}, {-0.3, 0.0, 3.1}, kRadiusMinM, 0.1).empty());
}

}  // namespace
}  // namespace adit
