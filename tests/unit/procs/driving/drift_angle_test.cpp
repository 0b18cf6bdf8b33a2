// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/drift_angle.hpp"

#include <cmath>
#include <initializer_list>
#include <random>

#include <gtest/gtest.h>

#include "procs/driving/controllers.hpp"

namespace adit {
namespace {

constexpr double kMotionStepM = 0.01;

/// Moves along an arc in a direction at an angle to the heading, and back in reverse if the length
/// is negative.
void drive(DriftAngle& drift, Pose2& T, double length_m, double curvature_1_m, double angle_rad) {
  const double direction = std::copysign(1.0, length_m);
  for (int i = 0; i < std::abs(length_m) / kMotionStepM; ++i) {
    const double course_rad = T.theta + angle_rad + 0.5 * kMotionStepM * direction * curvature_1_m;
    T.x += direction * kMotionStepM * std::cos(course_rad);
    T.y += direction * kMotionStepM * std::sin(course_rad);
    T.theta += direction * kMotionStepM * curvature_1_m;
    drift.add(T);
  }
}

TEST(DriftAngle, IsThatOfTheMotion) {
  for (const double curvature_1_m : {0.0, 0.3, -0.5}) {
    for (const double length_m : {1.0, -1.0}) {
      DriftAngle drift;
      Pose2 T{3.0, 1.0, 0.7};
      drive(drift, T, length_m, curvature_1_m, 0.03);
      EXPECT_NEAR(drift.angle_rad(), 0.03, 1e-4);
    }
  }
}

TEST(DriftAngle, IsZeroOnAnArcWithoutDrift) {
  DriftAngle drift;
  Pose2 T;
  drive(drift, T, 2.0, 0.6, 0.0);
  EXPECT_NEAR(drift.angle_rad(), 0.0, 1e-4);
}

TEST(DriftAngle, GrowsWithTheDistanceThatShowsIt) {
  DriftAngle drift;
  Pose2 T;
  EXPECT_EQ(drift.angle_rad(), 0.0);
  double before_rad = 0.0;
  for (double driven_m = 0.0; driven_m < DriftAngle::kWindowM + 0.2; driven_m += kMotionStepM) {
    drive(drift, T, kMotionStepM, 0.0, 0.04);
    EXPECT_GE(drift.angle_rad(), before_rad - 1e-9);
    EXPECT_LE(drift.angle_rad() - before_rad, 0.006);  // an eighth of it, and rounding
    before_rad = drift.angle_rad();
  }
  EXPECT_NEAR(before_rad, 0.04, 1e-4);
}

TEST(DriftAngle, AveragesErrorsOfPoses) {
  std::mt19937 random(1);
  std::normal_distribution<double> error_m(0.0, 0.005);
  DriftAngle drift;
  double sum2 = 0.0;
  int count = 0;
  for (double x = 0.0; x < 100.0; x += 0.0067) {  // 0.5 m/s at 75 Hz
    drift.add({x + error_m(random), 0.02 * x + error_m(random), 0.0});
    if (x < 1.0) continue;
    sum2 += std::pow(drift.angle_rad() - 0.02, 2);
    ++count;
  }
  // A line through nine means of seven poses: 5 mm / √7 / (5 cm √60).
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.0049, 0.0015);
}

TEST(DriftAngle, IsForgottenWithAStepOrAChangeOfDirection) {
  DriftAngle drift;
  Pose2 T;
  drive(drift, T, 1.0, 0.0, 0.04);
  DriftAngle reversed = drift;
  drive(reversed, T, -0.07, 0.0, 0.0);
  EXPECT_EQ(reversed.angle_rad(), 0.0);
  T.y += 2.0;
  drift.add(T);
  EXPECT_EQ(drift.angle_rad(), 0.0);
}

/// Lateral error after 10 m beside a straight path, by steps of Euler.
double remaining_error_m(double drift_rad, double assumed_rad) {
  const LateralParams params;
  double y_m = 0.0;
  double heading_rad = 0.0;
  for (int i = 0; i < 10.0 / kMotionStepM; ++i) {
    const double curvature_1_m =
        lateral_curvature({y_m, heading_rad}, 0.0, 1.0, params, assumed_rad);
    y_m += kMotionStepM * std::sin(heading_rad + drift_rad);
    heading_rad += kMotionStepM * curvature_1_m;
  }
  return y_m;
}

TEST(LateralCurvature, LeavesNoErrorWhereTheDriftIsKnown) {
  const double drift_rad = 0.02;
  // Where it is not: 2 · damping · response · drift.
  EXPECT_NEAR(remaining_error_m(drift_rad, 0.0), 2.0 * LateralParams{}.response_m * drift_rad,
              1e-3);
  EXPECT_NEAR(remaining_error_m(drift_rad, drift_rad), 0.0, 1e-4);
}

}  // namespace
}  // namespace adit
