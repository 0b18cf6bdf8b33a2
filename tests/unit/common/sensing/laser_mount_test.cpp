// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/laser_mount.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

using std::numbers::pi;

const LaserMount kFront{
    .T_body_laser = {1.05, 0.0, 0.0}, .height_m = 0.62, .lever_x_m = 0.06, .lever_z_m = 0.08};

void expect_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " is not " << b.transpose();
}

TEST(LaserMount, IsAtItsMountPoseWhenLevel) {
  const Eigen::Isometry3d T = tilted_laser(kFront, 0.0);
  expect_near(T.translation(), {1.05, 0.0, 0.62});
  EXPECT_TRUE(T.linear().isIdentity(1e-12));
}

TEST(LaserMount, TiltsDownwardsForAPositiveAngle) {
  // The axis is at (0.99, 0, 0.54); a quarter turn takes what was above it ahead of it.
  const Eigen::Isometry3d T = tilted_laser(kFront, pi / 2.0);
  expect_near(T.translation(), {0.99 + 0.08, 0.0, 0.54 - 0.06});
  expect_near(T.linear() * Eigen::Vector3d::UnitX(), {0.0, 0.0, -1.0});
  expect_near(T.linear() * Eigen::Vector3d::UnitY(), {0.0, 1.0, 0.0});
}

TEST(LaserMount, TiltsARearFacingLaserAboutItsOwnAxis) {
  LaserMount rear = kFront;
  rear.T_body_laser = {-1.05, 0.0, pi};
  const Eigen::Isometry3d T = tilted_laser(rear, pi / 2.0);
  expect_near(T.translation(), {-0.99 - 0.08, 0.0, 0.54 - 0.06});
  expect_near(T.linear() * Eigen::Vector3d::UnitX(), {0.0, 0.0, -1.0});
  expect_near(T.linear() * Eigen::Vector3d::UnitY(), {0.0, -1.0, 0.0});
}

TEST(LaserMount, AgreesWithAHandComputedTiltOfThirtyDegrees) {
  const Eigen::Isometry3d T = tilted_laser(kFront, pi / 6.0);
  const double c = std::sqrt(3.0) / 2.0;
  expect_near(T.translation(), {0.99 + 0.06 * c + 0.08 * 0.5, 0.0, 0.54 - 0.06 * 0.5 + 0.08 * c});
  expect_near(T.linear() * Eigen::Vector3d::UnitX(), {c, 0.0, -0.5});
}

}  // namespace
}  // namespace adit
