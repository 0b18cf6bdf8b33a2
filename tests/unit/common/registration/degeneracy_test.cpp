// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/degeneracy.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace adit {
namespace {

const Eigen::Matrix3d kNothing = Eigen::Matrix3d::Zero();

TEST(Degeneracy, KeepsWellConstrainedInformation) {
  Eigen::Matrix3d information;
  information << 1e5, 2e4, 1e3, 2e4, 9e4, 500, 1e3, 500, 4e6;
  const auto split = split_degenerate(information, kNothing, 3.0, {});
  EXPECT_TRUE(split.degenerate.empty());
  EXPECT_TRUE(split.information.isApprox(information, 1e-9));
  EXPECT_TRUE(split.covariance.isApprox(information.inverse(), 1e-9));
}

TEST(Degeneracy, ReportsTheUnconstrainedDirection) {
  // All normals along (0.6, 0.8): (0.8, −0.6) is unconstrained.
  const Eigen::Vector3d n(0.6, 0.8, 0.0);
  const Eigen::Matrix3d turn = Eigen::Vector3d(0, 0, 1e6).asDiagonal();
  const Eigen::Matrix3d information = 1e5 * n * n.transpose() + turn;
  const auto split = split_degenerate(information, kNothing, 2.0, {});
  ASSERT_EQ(split.degenerate.size(), 1U);
  EXPECT_NEAR(std::abs(split.degenerate[0].direction.dot(Eigen::Vector3d(0.8, -0.6, 0.0))), 1.0,
              1e-9);
  EXPECT_NEAR(
      Eigen::Vector3d(0.8, -0.6, 0.0).dot(split.information * Eigen::Vector3d(0.8, -0.6, 0)), 0.0,
      1e-6);
}

TEST(Degeneracy, DiscardsInformationProducedByNoisyNormals) {
  const Eigen::Matrix3d information = Eigen::Vector3d(2000, 1e5, 1e6).asDiagonal();
  const Eigen::Matrix3d spurious = Eigen::Vector3d(1000, 0, 0).asDiagonal();
  EXPECT_TRUE(split_degenerate(information, kNothing, 1.0, {}).degenerate.empty());
  ASSERT_EQ(split_degenerate(information, spurious, 1.0, {}).degenerate.size(), 1U);
}

TEST(Degeneracy, ReportsAllDirectionsWithoutInformation) {
  EXPECT_EQ(split_degenerate(kNothing, kNothing, 1.0, {}).degenerate.size(), 3U);
}

}  // namespace
}  // namespace adit
