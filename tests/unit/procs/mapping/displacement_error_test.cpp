// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/displacement_error.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kStepM = 0.1;
constexpr double kPeriodS = 0.2;

ScanMatch matched() {
  ScanMatch match;
  match.status = ScanMatch::Status::kMatched;
  match.reference_utime = 1'000'000;
  match.utime = match.reference_utime + static_cast<std::int64_t>(1e6 * kPeriodS);
  match.covariance.diagonal() << 4e-4, 1e-6, 1e-6;
  match.lever_arm_m = 2.0;
  return match;
}

ScanMatch open_along_x(DegenerateDirection::Fill fill) {
  ScanMatch match = matched();
  match.degenerate.push_back({Eigen::Vector3d::UnitX(), fill});
  return match;
}

void drive(DisplacementError& error, const ScanMatch& match, int steps) {
  for (int i = 0; i < steps; ++i) {
    error.add_step({kStepM, 0.0, 0.0}, match);
    error.add_travel(kStepM, 0.0);
  }
}

void reverse(DisplacementError& error, const ScanMatch& match, int steps) {
  for (int i = 0; i < steps; ++i) error.add_step({-kStepM, 0.0, 0.0}, match);
}

/// Of the errors of the wheels that of the scale alone.
DisplacementErrorParams without_walk() {
  DisplacementErrorParams params;
  params.wheels_m_per_sqrt_m = 0.0;
  return params;
}

double sd(const DisplacementError& error, int axis) {
  return std::sqrt(error.covariance()(axis, axis));
}

TEST(DisplacementError, IsPositiveDefiniteFromTheStart) {
  const DisplacementError error{DisplacementErrorParams{}};
  EXPECT_GT(error.covariance().determinant(), 0.0);
}

TEST(DisplacementError, GrowsWithPathLengthAndNotWithTheNumberOfScans) {
  DisplacementError few{DisplacementErrorParams{}};
  drive(few, matched(), 50);
  DisplacementError many{DisplacementErrorParams{}};
  for (int i = 0; i < 5000; ++i) {
    many.add_step({kStepM / 100.0, 0.0, 0.0}, matched());
    many.add_travel(kStepM / 100.0, 0.0);
  }
  EXPECT_NEAR(sd(few, 0), sd(many, 0), 1e-9);
  EXPECT_NEAR(sd(few, 2), sd(many, 2), 1e-9);
  EXPECT_NEAR(sd(few, 1), sd(many, 1), 1e-3);  // heading is sampled more finely
}

TEST(DisplacementError, OfHeadingPropagatesToPosition) {
  const DisplacementErrorParams params;
  DisplacementError error{params};
  drive(error, matched(), 500);
  // A random walk of the heading over L metres: sd² = q² L³ / 3 across the path.
  const double swept = params.drift_rad_per_sqrt_m * std::sqrt(50.0 * 50.0 * 50.0 / 3.0);
  EXPECT_NEAR(sd(error, 1), std::hypot(swept, params.drift_m_per_sqrt_m * std::sqrt(50.0)), 2e-3);
}

TEST(DisplacementError, UsesTheWheelsInDegenerateDirections) {
  const DisplacementErrorParams params;
  DisplacementError error{params};
  drive(error, open_along_x(DegenerateDirection::Fill::kOdometry), 50);
  const double walk_m = params.wheels_m_per_sqrt_m * std::sqrt(5.0);
  const double scale_m = params.wheels_scale_sd * 5.0;  // common to all steps
  const double drift_m = params.drift_m_per_sqrt_m * std::sqrt(5.0);
  const double all_m = std::sqrt(walk_m * walk_m + scale_m * scale_m + drift_m * drift_m);
  EXPECT_NEAR(sd(error, 0), all_m, params.floor_m);
  DisplacementError closed{DisplacementErrorParams{}};
  drive(closed, matched(), 50);
  EXPECT_NEAR(sd(error, 1), sd(closed, 1), 1e-6);  // the direction across is constrained by scans
}

/// Where every second scan constrains the direction, half of it is measured by the wheels.
TEST(DisplacementError, KeepsWhatTheWheelsFilledBetweenOtherScans) {
  const DisplacementErrorParams params;
  DisplacementError error{params};
  for (int i = 0; i < 25; ++i) {
    drive(error, open_along_x(DegenerateDirection::Fill::kOdometry), 1);
    drive(error, matched(), 1);
  }
  const double walk_m = params.wheels_m_per_sqrt_m * std::sqrt(2.5);
  const double scale_m = params.wheels_scale_sd * 2.5;
  const double drift_m = params.drift_m_per_sqrt_m * std::sqrt(5.0);
  const double all_m = std::sqrt(walk_m * walk_m + scale_m * scale_m + drift_m * drift_m);
  EXPECT_NEAR(sd(error, 0), all_m, params.floor_m);
}

TEST(DisplacementError, OfTheWheelsDependsOnDistanceAndNotOnTheNumberOfScans) {
  DisplacementError few{DisplacementErrorParams{}};
  drive(few, open_along_x(DegenerateDirection::Fill::kOdometry), 50);
  DisplacementError many{DisplacementErrorParams{}};
  for (int i = 0; i < 5000; ++i) {
    many.add_step({kStepM / 100.0, 0.0, 0.0}, open_along_x(DegenerateDirection::Fill::kOdometry));
    many.add_travel(kStepM / 100.0, 0.0);
  }
  EXPECT_NEAR(sd(few, 0), sd(many, 0), 1e-9);
}

TEST(DisplacementError, TakesTheErrorOfScaleThatScanMatchingStates) {
  const DisplacementErrorParams params = without_walk();
  ScanMatch match = open_along_x(DegenerateDirection::Fill::kOdometry);
  match.wheels_scale_sd = 0.06;
  DisplacementError error{params};
  drive(error, match, 50);
  EXPECT_NEAR(sd(error, 0), 0.06 * 5.0, 0.001);
  match.wheels_scale_sd = 0.001;  // other ground may have another scale
  DisplacementError least{params};
  drive(least, match, 50);
  EXPECT_NEAR(sd(least, 0), params.wheels_scale_sd * 5.0, 0.002);
}

/// A pose graph adds the variances of displacements up as if they were independent.
TEST(DisplacementError, OfAStretchByTheWheelsAddsUpToThatOfItsLength) {
  const DisplacementErrorParams params = without_walk();
  DisplacementError error{params};
  const ScanMatch match = open_along_x(DegenerateDirection::Fill::kOdometry);
  double variance = 0.0;
  for (int map = 0; map < 4; ++map) {
    error.reset();
    drive(error, match, 50);
    variance += error.covariance()(0, 0);
  }
  EXPECT_NEAR(std::sqrt(variance), params.wheels_scale_sd * 20.0, 0.002);
  error.reset();
  drive(error, matched(), 50);  // here scans measure
  error.reset();
  drive(error, match, 50);
  EXPECT_NEAR(sd(error, 0), params.wheels_scale_sd * 5.0, 0.002);
}

/// In reverse the same error of scale shortens what it had lengthened.
TEST(DisplacementError, OfAStretchByTheWheelsDoesNotGrowInReverse) {
  const DisplacementErrorParams params = without_walk();
  DisplacementError error{params};
  const ScanMatch match = open_along_x(DegenerateDirection::Fill::kOdometry);
  drive(error, match, 50);
  error.reset();
  reverse(error, match, 50);
  EXPECT_NEAR(sd(error, 0), params.wheels_scale_sd * 5.0, 0.002);
}

TEST(DisplacementError, OfTheScaleOfWheelsVanishesThereAndBack) {
  const DisplacementErrorParams params = without_walk();
  DisplacementError error{params};
  ScanMatch match = open_along_x(DegenerateDirection::Fill::kOdometry);
  drive(error, match, 50);
  EXPECT_GT(sd(error, 0), params.wheels_scale_sd * 5.0);
  reverse(error, match, 50);
  DisplacementError closed{params};
  drive(closed, matched(), 50);
  EXPECT_NEAR(sd(error, 0), sd(closed, 0), 1e-9);
}

/// What is less known of the scale than it can be is the same error in all displacements.
TEST(DisplacementError, StatesTheErrorOfTheScaleThatIsCommonToAll) {
  const DisplacementErrorParams params = without_walk();
  ScanMatch match = open_along_x(DegenerateDirection::Fill::kOdometry);
  match.wheels_scale_sd = 0.05;
  const double common_sd = std::sqrt(0.05 * 0.05 - params.wheels_scale_sd * params.wheels_scale_sd);
  DisplacementError error{params};
  for (int map = 1; map <= 3; ++map) {
    error.reset();
    drive(error, match, 50);
    const WheelScaleError scale_error = error.wheel_scale_error();
    EXPECT_NEAR(scale_error.error.x(), common_sd * 5.0, 1e-9);
    EXPECT_NEAR(scale_error.scale_sd, common_sd, 1e-12);
    EXPECT_NEAR(scale_error.times, 2.0 * map - 1.0, 1e-9);
  }
  error.reset();
  reverse(error, match, 50);
  EXPECT_NEAR(error.wheel_scale_error().error.x(), -common_sd * 5.0, 1e-9);
  EXPECT_NEAR(error.wheel_scale_error().times, 1.0, 1e-9);
  error.reset();
  drive(error, matched(), 50);
  EXPECT_EQ(error.wheel_scale_error().scale_sd, 0.0);
}

TEST(DisplacementError, OfAnAssumedSpeedGrowsWithTime) {
  const DisplacementErrorParams params;
  DisplacementError error{params};
  drive(error, open_along_x(DegenerateDirection::Fill::kNone), 50);
  EXPECT_NEAR(sd(error, 0), params.speed_sd_m_s * kPeriodS * 50, 0.01);
  drive(error, matched(), 10);  // and remains
  EXPECT_GT(sd(error, 0), 0.99 * params.speed_sd_m_s * kPeriodS * 50);
}

/// 20 m and a quarter turn without a scan: the opposite heading is not likely.
TEST(DisplacementError, CarriesALongStepWithoutScansByTheWheels) {
  ScanMatch lost;
  lost.status = ScanMatch::Status::kLost;
  lost.reference_utime = 0;
  lost.utime = 60'000'000;
  lost.covariance = Eigen::Vector3d(4.0, 4.0, 1.2).asDiagonal();  // as of the prior of the match
  const Pose2 step{-19.0, 4.0, -1.5};
  DisplacementError error{DisplacementErrorParams{}};
  error.add_step(step, lost, step);
  const Eigen::Matrix3d covariance = error.covariance();
  EXPECT_LT(std::sqrt(covariance(2, 2)), 0.25);  // the walk of the wheels: 0.18 rad
  EXPECT_GT(std::sqrt(covariance(2, 2)), 0.1);
  EXPECT_GT(std::sqrt(covariance(0, 0)), 1.0);  // 0.18 rad over 19 m, divided by √3: 2 m
}

TEST(DisplacementError, DropsAShortDegenerateOrLostStretch) {
  DisplacementError closed{DisplacementErrorParams{}};
  drive(closed, matched(), 10);
  DisplacementError open{DisplacementErrorParams{}};
  drive(open, open_along_x(DegenerateDirection::Fill::kNone), 3);
  EXPECT_GT(sd(open, 0), 0.1);  // it counts while it lasts
  drive(open, matched(), 7);
  EXPECT_NEAR(sd(open, 0), sd(closed, 0), 1e-9);

  ScanMatch lost = matched();
  lost.status = ScanMatch::Status::kLost;
  lost.covariance.diagonal() << 0.9, 0.9, 1.0;
  DisplacementError short_loss{DisplacementErrorParams{}};
  drive(short_loss, lost, 2);
  drive(short_loss, matched(), 8);
  EXPECT_NEAR(sd(short_loss, 0), sd(closed, 0), 1e-9);
  DisplacementError long_loss{DisplacementErrorParams{}};
  drive(long_loss, lost, 4);
  drive(long_loss, matched(), 6);
  EXPECT_GT(sd(long_loss, 0), 0.2);  // the reference of scan matching was reset
}

/// Straight at 0.4 m/s; front and rear laser alternate. The rear one is beside the front one.
DisplacementError with_two_lasers(double rear_beside_m) {
  DisplacementError error{DisplacementErrorParams{}};
  ScanMatch match = matched();
  match.utime = match.reference_utime + 13'000;
  double side_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    match.channel = i % 2 == 0 ? "LASER_FRONT" : "LASER_REAR";
    const double next_side_m = i % 2 == 0 ? 0.0 : rear_beside_m;
    error.add_step({0.0052, next_side_m - side_m, 0.0}, match);
    side_m = next_side_m;
  }
  return error;
}

TEST(DisplacementError, HasHalfTheDisagreementOfTwoLasers) {
  const Eigen::Matrix3d agreeing = with_two_lasers(0.0).covariance();
  const Eigen::Matrix3d parted = with_two_lasers(0.12).covariance();
  EXPECT_NEAR(parted(1, 1) - agreeing(1, 1), 0.06 * 0.06, 1e-9);
  EXPECT_NEAR(parted(0, 0) - agreeing(0, 0), 0.0, 1e-9);
}

TEST(DisplacementError, HasNoDisagreementOfOneLaser) {
  DisplacementError error{DisplacementErrorParams{}};
  const double before = sd(error, 0);
  for (int i = 0; i < 10; ++i) error.add_step({i % 2 == 0 ? 0.0 : 0.1, 0.0, 0.0}, matched());
  EXPECT_NEAR(sd(error, 0), before, 1e-9);
}

TEST(DisplacementError, ForgetsTheDisagreementOfTheLastDisplacement) {
  DisplacementError error = with_two_lasers(0.12);
  error.reset();
  const DisplacementError fresh{DisplacementErrorParams{}};
  EXPECT_NEAR(sd(error, 1), sd(fresh, 1), 1e-12);
}

/// Five metres at 0.5 m/s, where the wheels measure `wheels_share` of what the scans do over the
/// second metre.
DisplacementError with_wheels(double wheels_share, double pitch_rad = 0.0) {
  DisplacementError error{DisplacementErrorParams{}};
  ScanMatch match = matched();
  if (pitch_rad != 0.0) match.attitude = Attitude{0.0, pitch_rad};
  for (int i = 0; i < 50; ++i) {
    match.reference_utime = match.utime;
    match.utime += static_cast<std::int64_t>(1e6 * kPeriodS);
    const double share = i >= 10 && i < 20 ? wheels_share : 1.0;
    error.add_step({kStepM, 0.0, 0.0}, match,
                   Pose2{share * kStepM / std::cos(pitch_rad), 0.0, 0.0});
  }
  return error;
}

TEST(DisplacementError, CoversScansAndWheelsWhereTheyDisagree) {
  const Eigen::Matrix3d agreeing = with_wheels(1.0).covariance();
  for (const double share : {0.6, 1.4}) {
    const Eigen::Matrix3d slipped = with_wheels(share).covariance();
    const double sd_m = std::sqrt(slipped(0, 0) - agreeing(0, 0));
    EXPECT_GT(2.448 * sd_m, 0.4);  // with 95 % the truth may be where the wheels are
    EXPECT_LT(sd_m, 0.5 * 0.4 + 1e-9);
    EXPECT_NEAR(slipped(1, 1), agreeing(1, 1), 1e-9);  // across, they agree
  }
}

TEST(DisplacementError, HasNoSlipThatWheelsAndScansExplain) {
  DisplacementError scans{DisplacementErrorParams{}};
  for (int i = 0; i < 50; ++i) scans.add_step({kStepM, 0.0, 0.0}, matched());
  EXPECT_NEAR(sd(with_wheels(0.98), 0), sd(scans, 0), 1e-9);
}

TEST(DisplacementError, ComparesWheelsInThePlan) {
  EXPECT_NEAR(sd(with_wheels(1.0, 0.35), 0), sd(with_wheels(1.0), 0),
              1e-9);  // 6 % longer on the slope
}

TEST(DisplacementError, TurnsASlipWithTheBody) {
  DisplacementError error = with_wheels(0.6);
  const double along = error.covariance()(0, 0);
  const double across = error.covariance()(1, 1);
  error.add_step({0.0, 0.0, 0.5 * std::numbers::pi}, matched(), std::nullopt);
  EXPECT_NEAR(error.covariance()(1, 1), along, 1e-9);
  EXPECT_NEAR(error.covariance()(0, 0), across, 1e-9);
  error.reset();
  EXPECT_NEAR(sd(error, 0), DisplacementErrorParams{}.floor_m, 1e-9);
}

TEST(DisplacementError, KeepsWhatSlippedThereAndBack) {
  DisplacementError error{DisplacementErrorParams{}};
  ScanMatch match = matched();
  for (int i = 0; i < 60; ++i) {
    match.reference_utime = match.utime;
    match.utime += static_cast<std::int64_t>(1e6 * kPeriodS);
    const double slip_m = i < 10 ? 0.03 : i < 20 ? -0.03 : 0.0;
    error.add_step({kStepM, 0.0, 0.0}, match, Pose2{kStepM - slip_m, 0.0, 0.0});
  }
  EXPECT_GT(2.448 * sd(error, 0), 0.25);  // the walls between are bent by 0.3 m
}

}  // namespace
}  // namespace adit
