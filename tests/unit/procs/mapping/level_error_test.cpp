// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/level_error.hpp"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPriorSd = 0.005;

/// The rotation vector about x and y that remains between two level frames whose bodies differ by a
/// turn, and which are both inclined by `error_rad` about the axes of the body: composed exactly.
Eigen::Vector2d tilt_between(double turn_rad, const Eigen::Vector2d& error_rad) {
  const auto inclined = [&](double heading) -> Eigen::Matrix3d {
    const Eigen::Vector3d e(error_rad.x(), error_rad.y(), 0.0);
    return Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
           Eigen::AngleAxisd(e.norm(), e.stableNormalized()).toRotationMatrix().transpose();
  };
  const Eigen::Matrix3d R = inclined(0.0).transpose() * inclined(turn_rad);
  const double turn = std::atan2(R(1, 0), R(0, 0));
  const Eigen::AngleAxisd tilt(
      Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R);
  return tilt.angle() * tilt.axis().head<2>();
}

TEST(LevelError, OneHeadingDoesNotShowIt) {
  LevelError error(kPriorSd);
  for (int i = 0; i < 50; ++i) error.add(0.0, {0.0, 0.0}, 1e-6 * Eigen::Matrix2d::Identity());
  EXPECT_NEAR(error.covariance()(1, 1), kPriorSd * kPriorSd, 1e-12);
}

TEST(LevelError, IsFoundByATurn) {
  const Eigen::Vector2d truth(0.004, -0.003);
  for (const double turn : {0.3, 1.5, -2.5, 3.1}) {
    LevelError error(kPriorSd);
    error.add(turn, tilt_between(turn, truth), 1e-10 * Eigen::Matrix2d::Identity());
    EXPECT_LT((error.error_rad() - truth).norm(), 5e-5) << turn;
  }
}

TEST(LevelError, IsAsSureAsItStates) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 500;
  constexpr double kNoise = 0.001;
  double sum = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector2d truth = kPriorSd * Eigen::Vector2d(normal(random), normal(random));
    LevelError error(kPriorSd);
    for (int i = 0; i < 5; ++i) {
      const double turn = 0.5 * normal(random);
      const Eigen::Vector2d noise = kNoise * Eigen::Vector2d(normal(random), normal(random));
      error.add(turn, tilt_between(turn, truth) + noise,
                kNoise * kNoise * Eigen::Matrix2d::Identity());
    }
    const Eigen::Vector2d off = error.error_rad() - truth;
    sum += off.dot(error.covariance().inverse() * off);
  }
  EXPECT_NEAR(sum / kTrials, 2.0, 0.3);
}

TEST(LevelError, IgnoresATiltThatItCannotExplain) {
  LevelError error(kPriorSd);
  error.add(1.5, {0.2, 0.0}, 1e-6 * Eigen::Matrix2d::Identity());
  EXPECT_EQ(error.error_rad(), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace adit
