// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/gravity.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace adit {
namespace {

GravityEstimator estimator_after(int readings, const Eigen::Vector3d& force) {
  GravityEstimator gravity(GravityParams{});
  for (int i = 0; i < readings; ++i) gravity.add({1000 * i, {}, force});
  return gravity;
}

TEST(GravityEstimator, IsTheMeanOfTheSpecificForceAtRest) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.05, 1.0).normalized();
  EXPECT_LT((*estimator_after(100, 9.81 * up).up_body() - up).norm(), 1e-12);
}

TEST(GravityEstimator, IsUnknownWithFewReadingsOrWithoutRest) {
  EXPECT_FALSE(estimator_after(99, {0.0, 0.0, 9.81}).up_body());
  EXPECT_FALSE(estimator_after(100, {0.0, 0.0, 10.5}).up_body());
  EXPECT_FALSE(estimator_after(100, {0.0, 0.0, 0.0}).up_body());
}

TEST(GravityEstimator, DropsOldReadings) {
  GravityEstimator gravity = estimator_after(100, {9.81, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) gravity.add({i, {}, {0.0, 0.0, 9.81}});
  EXPECT_EQ(*gravity.up_body(), Eigen::Vector3d::UnitZ());
}

TEST(LevelRotation, TakesUpToZAndKeepsTheHeading) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.2, -0.3, 1.0).normalized();
  const Eigen::Matrix3d R = level_rotation(up);
  EXPECT_LT((R * up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  const Eigen::Vector3d forward = R * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(forward.y(), 0.0, 1e-12);
  EXPECT_GT(forward.x(), 0.0);
}

}  // namespace
}  // namespace adit
