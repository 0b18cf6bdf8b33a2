// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/common_scale_error.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kExact = 1e-12;

WheelScaleError along(double error_m, double scale_sd = 0.05, double times = 1.0) {
  return {{error_m, 0.0, 0.0}, scale_sd, times};
}

TEST(CommonScaleError, CancelsOutAndBack) {
  const double error_m = 0.25;
  const std::vector<WheelScaleError> errors{along(error_m), along(error_m), along(-error_m),
                                            along(-error_m)};
  const double contained = 4.0 * error_m * error_m;
  EXPECT_NEAR(common_scale_covariance(errors)(0, 0), -contained, kExact);
}

TEST(CommonScaleError, AddsUpStraightOn) {
  const double error_m = 0.25;
  const std::vector<WheelScaleError> errors(4, along(error_m));
  const double contained = 4.0 * error_m * error_m;
  EXPECT_NEAR(common_scale_covariance(errors)(0, 0), 16.0 * error_m * error_m - contained, kExact);
}

/// DisplacementError states the k-th of a stretch 2k - 1 times.
TEST(CommonScaleError, IsThatOfTheDisplacementsOnAStraightStretch) {
  std::vector<WheelScaleError> errors;
  for (int k = 1; k <= 4; ++k) errors.push_back(along(0.25, 0.05, 2.0 * k - 1.0));
  EXPECT_NEAR(common_scale_covariance(errors)(0, 0), 0.0, kExact);
}

TEST(CommonScaleError, IsIndependentOfTheOrder) {
  const WheelScaleError x{{0.2, 0.1, 0.0}, 0.05, 1.0};
  const WheelScaleError y{{-0.1, 0.3, 0.01}, 0.02, 3.0};
  const WheelScaleError z{{0.05, 0.0, 0.0}, 0.03, 1.0};
  const Eigen::Matrix3d expected = common_scale_covariance({x, y, z});
  EXPECT_LT((common_scale_covariance({z, y, x}) - expected).norm(), kExact);
  EXPECT_LT((common_scale_covariance({y, x, z}) - expected).norm(), kExact);
}

/// A constant scale that more and more measurements estimate, used after each of them.
TEST(CommonScaleError, IsThatOfAnEstimateThatBecomesBetter) {
  constexpr double kPriorSd = 0.05;
  constexpr std::array kDistancesM{5.0, 5.0, -5.0, 4.0, -9.0};
  constexpr std::array kMeasurementSds{1e6, 0.05, 0.03, 1e6, 0.02};  // before each distance
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 200'000;
  double squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double scale = kPriorSd * normal(random);
    double estimate = 0.0;
    double information = 1.0 / (kPriorSd * kPriorSd);
    double error_m = 0.0;
    for (std::size_t i = 0; i < kDistancesM.size(); ++i) {
      const double sd = kMeasurementSds[i];
      const double gain = 1.0 / (sd * sd) / (information + 1.0 / (sd * sd));
      estimate += gain * (scale + sd * normal(random) - estimate);
      information += 1.0 / (sd * sd);
      error_m += (estimate - scale) * kDistancesM[i];
    }
    squares += error_m * error_m / kTrials;
  }
  std::vector<WheelScaleError> errors;
  double information = 1.0 / (kPriorSd * kPriorSd);
  double contained = 0.0;
  for (std::size_t i = 0; i < kDistancesM.size(); ++i) {
    information += 1.0 / (kMeasurementSds[i] * kMeasurementSds[i]);
    const double sd = std::sqrt(1.0 / information);
    errors.push_back(along(sd * kDistancesM[i], sd));
    contained += sd * sd * kDistancesM[i] * kDistancesM[i];
  }
  EXPECT_NEAR(contained + common_scale_covariance(errors)(0, 0), squares, 0.02 * squares);
}

TEST(CommonScaleError, OfTwoDisplacementsIsTheirSum) {
  const WheelScaleError both =
      composed(along(0.1, 0.05), along(0.2, 0.03), Eigen::Matrix3d::Identity());
  EXPECT_NEAR(both.error.x(), 0.3, kExact);
  EXPECT_EQ(both.scale_sd, 0.05);
  // The covariance of both contains 0.01 + 0.04.
  EXPECT_NEAR(both.times * 0.09, 0.05, kExact);
}

}  // namespace
}  // namespace adit
