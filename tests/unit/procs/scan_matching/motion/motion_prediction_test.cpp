// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/motion/motion_prediction.hpp"

#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kStart = 1000 * kSecond;

WheelOdometry wheels(double t_s, const Pose2& pose) {
  return {kStart + static_cast<std::int64_t>(t_s * 1e6), pose};
}

ImuReading turning(double t_s, double rate) {
  ImuReading reading;
  reading.utime = kStart + static_cast<std::int64_t>(t_s * 1e6);
  reading.angular_velocity.z() = rate;
  return reading;
}

TEST(MotionPrediction, UsesTheStepOfTheWheels) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {5.0, 1.0, 0.5}, true);
  motion.add(wheels(0.0, {100.0, 0.0, 2.0}));
  motion.add(wheels(1.0, Pose2{100.0, 0.0, 2.0} * Pose2{0.4, 0.1, 0.2}));
  const auto expected = motion.predict(kStart + kSecond);
  EXPECT_TRUE(expected.from_odometry);
  const Pose2 step = between({5.0, 1.0, 0.5}, expected.prior.T_odom_body);
  EXPECT_NEAR((step.vector() - Eigen::Vector3d(0.4, 0.1, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_GT(expected.prior.information(0, 0), 0.0);
}

/// Over a hump, leaning: the pitch changes, and the heading stays.
TEST(MotionPrediction, DoesNotTakeAChangeOfPitchForATurn) {
  constexpr double kRoll = -0.08;
  constexpr double kPitchRate = -0.08;
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {5.0, 1.0, 0.5}, true);
  for (int i = 0; i <= 100; ++i) {
    ImuReading reading = turning(0.01 * i, -kPitchRate * std::sin(kRoll));
    reading.angular_velocity.y() = kPitchRate * std::cos(kRoll);
    motion.add(reading, {kRoll, 0.3 + 0.01 * i * kPitchRate});
  }
  EXPECT_NEAR(motion.predict(kStart + kSecond).prior.T_odom_body.theta, 0.5, 1e-9);
}

TEST(MotionPrediction, ScalesTheStepOfTheWheels) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {5.0, 1.0, 0.5}, true);
  motion.add(wheels(0.0, {}));
  motion.add(wheels(1.0, {0.4, 0.1, 0.2}));
  const auto expected = motion.predict(kStart + kSecond, 0.9);
  const Pose2 step = between({5.0, 1.0, 0.5}, expected.prior.T_odom_body);
  EXPECT_NEAR((step.vector() - Eigen::Vector3d(0.36, 0.09, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_EQ(expected.wheels_step, (Pose2{0.4, 0.1, 0.2}));
}

TEST(MotionPrediction, InterpolatesBetweenWheelReadings) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart + kSecond / 2, {}, true);
  motion.add(wheels(0.0, {0.0, 0.0, 0.0}));
  motion.add(wheels(1.0, {1.0, 0.0, 0.0}));
  motion.add(wheels(2.0, {2.0, 0.0, 0.0}));
  EXPECT_NEAR(motion.predict(kStart + kSecond * 5 / 4).prior.T_odom_body.x, 0.75, 1e-12);
}

TEST(MotionPrediction, BoundsMotionFromTheLastScanThatWasLocated) {
  const MotionPredictionParams params;
  MotionPrediction motion{params};
  motion.correct(kStart, {1.0, 0.0, 0.0}, true);
  motion.correct(kStart + 2 * kSecond, {3.0, 0.0, 0.0}, false, false);
  const auto expected = motion.predict(kStart + 4 * kSecond);
  EXPECT_EQ(expected.T_odom_last, (Pose2{1.0, 0.0, 0.0}));
  EXPECT_NEAR(expected.unmeasured_s, 4.0, 1e-9);
  EXPECT_NEAR(expected.displacement_max_m, params.speed_max_m_s * (4.0 + params.stamp_error_max_s),
              1e-9);
}

TEST(MotionPrediction, IgnoresStaleWheelReadings) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {}, true);
  motion.add(wheels(0.0, {}));
  const auto expected = motion.predict(kStart + 2 * kSecond);
  EXPECT_FALSE(expected.from_odometry);
  EXPECT_TRUE(expected.prior.information.isZero());
}

TEST(MotionPrediction, IgnoresWheelsThatJump) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {}, true);
  motion.add(wheels(0.0, {}));
  motion.add(wheels(0.2, {30.0, 0.0, 0.0}));
  EXPECT_FALSE(motion.predict(kStart + kSecond / 5).from_odometry);
}

TEST(MotionPrediction, RejectsReadingsThatDoNotAdvance) {
  MotionPrediction motion{MotionPredictionParams{}};
  EXPECT_TRUE(motion.add(wheels(1.0, {})));
  EXPECT_FALSE(motion.add(wheels(1.0, {1.0, 0.0, 0.0})));
  EXPECT_FALSE(motion.add(wheels(0.5, {})));
  EXPECT_TRUE(motion.add(turning(1.0, 0.0)));
  EXPECT_FALSE(motion.add(turning(1.0, 0.0)));
}

TEST(MotionPrediction, IntegratesTheGyroOverTheStep) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {0.0, 0.0, 1.0}, true);
  for (int i = 0; i <= 10; ++i) motion.add(turning(0.1 * i, 0.3));
  const auto expected = motion.predict(kStart + kSecond);
  EXPECT_TRUE(expected.from_gyro);
  EXPECT_NEAR(expected.prior.T_odom_body.theta, 1.3, 1e-9);
  EXPECT_GT(expected.prior.information(2, 2), 0.0);
  EXPECT_EQ(expected.prior.information(0, 0), 0.0);
}

/// A straight tunnel looks the same in the opposite direction, which a wide prior admits.
TEST(MotionPrediction, RulesOutTheOppositeHeadingByTheGyroAfterALongTimeWithoutAScan) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {}, true);
  for (int i = 0; i <= 500; ++i) motion.add(turning(0.1 * i, 0.01));
  const auto expected = motion.predict(kStart + 50 * kSecond);  // the turn is 0.5 ± 0.5 rad
  EXPECT_TRUE(expected.possible({20.0, 0.0, 0.5}));
  EXPECT_TRUE(expected.possible({20.0, 0.0, 2.0}));
  EXPECT_FALSE(expected.possible({20.0, 0.0, 0.5 + std::numbers::pi}));
  EXPECT_FALSE(expected.possible({20.0, 0.0, 0.5 - 2.5}));
  // Over a short step a match corrects the heading by as much as is needed.
  EXPECT_TRUE(motion.predict(kStart + kSecond / 2).possible({0.0, 0.0, 0.6}));
}

TEST(MotionPrediction, IgnoresTheGyroAcrossAGap) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {}, true);
  motion.add(turning(0.0, 0.3));
  motion.add(turning(0.9, 0.3));
  EXPECT_FALSE(motion.predict(kStart + kSecond).from_gyro);
}

TEST(MotionPrediction, ExtrapolatesTheLastSpeedWithoutSensors) {
  MotionPredictionParams params;
  MotionPrediction motion{params};
  motion.correct(kStart, {}, true);
  motion.correct(kStart + kSecond, {0.5, 0.0, 0.0}, true);
  const double x = motion.predict(kStart + 2 * kSecond).prior.T_odom_body.x;
  EXPECT_GT(x, 0.9);  // the speed decays over 5 s
  EXPECT_LE(x, 1.0);
}

/// In a tunnel that does not constrain the motion along it, the pose of each scan is the
/// prediction.
TEST(MotionPrediction, ExtrapolatedDistanceDoesNotDependOnTheNumberOfScans) {
  const MotionPredictionParams params;
  constexpr double kSpeedM_s = 0.4;
  constexpr double kOpenS = 20.0;
  const double memory_s = params.speed_memory_s;
  // The integral of an exponentially decaying speed.
  const double expected_m = kSpeedM_s * memory_s * (1.0 - std::exp(-kOpenS / memory_s));
  for (const int scans : {20, 100, 1500}) {
    MotionPrediction motion{params};
    motion.correct(kStart, {}, true);
    motion.correct(kStart + kSecond, {kSpeedM_s, 0.0, 0.0}, true);
    Pose2 T_odom_body{kSpeedM_s, 0.0, 0.0};
    for (int i = 1; i <= scans; ++i) {
      const std::int64_t utime = kStart + kSecond + i * 20 * kSecond / scans;
      T_odom_body = motion.predict(utime).prior.T_odom_body;
      motion.correct(utime, T_odom_body, false);
    }
    EXPECT_NEAR(T_odom_body.x - kSpeedM_s, expected_m, 1e-3) << scans;  // whole microseconds
  }
}

TEST(MotionPrediction, MeasuresNoSpeedFromNearlyEqualTimeStamps) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.correct(kStart, {}, true);
  motion.correct(kStart + 1000, {0.3, 0.0, 0.0}, true);
  EXPECT_NEAR(motion.predict(kStart + kSecond).prior.T_odom_body.x, 0.3, 1e-9);
}

TEST(MotionPrediction, IsStationaryAfterTheWheelsHaveStoodForAWhile) {
  MotionPrediction motion{MotionPredictionParams{}};
  motion.add(wheels(-1.0, {}));
  motion.add(wheels(-0.3, {0.2, 0.0, 0.0}));
  motion.add(wheels(0.1, {0.2, 0.0, 0.0}));
  motion.correct(kStart, {}, true);
  EXPECT_FALSE(motion.predict(kStart + kSecond / 10).stationary);  // repeated odometry
  motion.add(wheels(0.4, {0.2, 0.0, 0.0}));
  EXPECT_TRUE(motion.predict(kStart + 4 * kSecond / 10).stationary);
  motion.add(wheels(0.5, {0.21, 0.0, 0.0}));
  EXPECT_FALSE(motion.predict(kStart + kSecond / 2).stationary);
}

TEST(MotionPrediction, IsNotStationaryWhileTheGyroTurns) {
  MotionPrediction motion{MotionPredictionParams{}};
  for (int i = -10; i <= 10; ++i) {
    motion.add(wheels(0.1 * i, {}));
    motion.add(turning(0.1 * i, 0.2));
  }
  motion.correct(kStart, {}, true);
  EXPECT_FALSE(motion.predict(kStart + kSecond).stationary);
}

TEST(MotionPrediction, UncertaintyDoesNotDependOnTheNumberOfSteps) {
  MotionPredictionParams params;
  MotionPrediction motion{params};
  motion.add(wheels(0.0, {}));
  motion.add(wheels(0.2, {}));
  motion.correct(kStart, {}, true);
  const double steps = 10.0;
  const auto each = motion.predict(kStart + std::llround(0.02 * kSecond)).prior.information;
  const auto all = motion.predict(kStart + std::llround(0.2 * kSecond)).prior.information;
  EXPECT_NEAR(each(0, 0) / steps, all(0, 0), 1e-9 * all(0, 0));
  EXPECT_NEAR(each(2, 2) / steps, all(2, 2), 1e-9 * all(2, 2));
}

}  // namespace
}  // namespace adit
