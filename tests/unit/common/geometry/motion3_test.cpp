// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/motion3.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Motion3, IsTheCrossProduct) {
  const Eigen::Vector3d a(0.3, -1.2, 2.5);
  const Eigen::Vector3d b(-0.7, 0.4, 1.1);
  EXPECT_TRUE((skew(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST(Motion3, ReturnsTheSameMotion) {
  Vector6d motion;
  motion << 1.0, -2.0, 0.5, 0.3, -0.9, 2.1;
  EXPECT_TRUE(motion_of(isometry_of(motion)).isApprox(motion, 1e-12));
  EXPECT_EQ(motion_of(isometry_of(Vector6d::Zero())), Vector6d::Zero());
}

/// For small angles T p = p + t + ω × p; a quarter turn in closed form.
TEST(Motion3, TurnsByTheRotationVector) {
  Vector6d motion;
  motion << 0.1, 0.2, 0.3, 1e-5, -2e-5, 3e-5;
  const Eigen::Vector3d p(4.0, -3.0, 2.0);
  const Eigen::Vector3d expected = p + motion.head<3>() + skew(motion.tail<3>()) * p;
  EXPECT_TRUE((isometry_of(motion) * p).isApprox(expected, 1e-8));
  motion << 0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * EIGEN_PI;
  EXPECT_TRUE(
      (isometry_of(motion) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
}

}  // namespace
}  // namespace adit
