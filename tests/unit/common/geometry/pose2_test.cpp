// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/pose2.hpp"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Angle, WrapsToTheHalfOpenIntervalThatIncludesPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi / 2.0), -kPi / 2.0, 1e-15);
  EXPECT_NEAR(wrap_angle(-7.0), -7.0 + 2.0 * kPi, 1e-15);
  EXPECT_DOUBLE_EQ(wrap_angle(0.0), 0.0);
}

TEST(Angle, DifferenceIsTheShorterTurn) {
  EXPECT_NEAR(angle_diff(deg_to_rad(179.0), deg_to_rad(-179.0)), deg_to_rad(-2.0), 1e-12);
  EXPECT_NEAR(angle_diff(deg_to_rad(-179.0), deg_to_rad(179.0)), deg_to_rad(2.0), 1e-12);
}

TEST(Angle, DegreesAndRadiansAreInverse) { EXPECT_DOUBLE_EQ(rad_to_deg(deg_to_rad(37.5)), 37.5); }

}  // namespace
namespace {

Eigen::Matrix3d matrix(const Pose2& T) {
  Eigen::Matrix3d m;
  m << std::cos(T.theta), -std::sin(T.theta), T.x, std::sin(T.theta), std::cos(T.theta), T.y, 0, 0,
      1;
  return m;
}

class Pose2Laws : public testing::Test {
 protected:
  Pose2 random_pose() { return {metres_(rng_), metres_(rng_), radians_(rng_)}; }

 private:
  std::mt19937 rng_{7};
  std::uniform_real_distribution<double> metres_{-50.0, 50.0};
  std::uniform_real_distribution<double> radians_{-3.14, 3.14};
};

TEST_F(Pose2Laws, CompositionIsTheMatrixProduct) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = random_pose();
    const Pose2 b = random_pose();
    EXPECT_TRUE(matrix(a * b).isApprox(matrix(a) * matrix(b), 1e-12));
  }
}

TEST_F(Pose2Laws, InverseIsTheMatrixInverse) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = random_pose();
    EXPECT_TRUE(matrix(a.inverse()).isApprox(matrix(a).inverse(), 1e-12));
  }
}

TEST_F(Pose2Laws, BetweenUndoesComposition) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 a = random_pose();
    const Pose2 b = random_pose();
    EXPECT_NEAR((between(a, a * b).vector() - b.vector()).norm(), 0.0, 1e-12);
  }
}

TEST_F(Pose2Laws, AdjointTransformsASmallMotionToTheOtherFrame) {
  for (int i = 0; i < 100; ++i) {
    const Pose2 T_a_b = random_pose();
    const Eigen::Vector3d small = 1e-7 * random_pose().vector();
    const Pose2 moved = T_a_b * Pose2::from_vector(small) * T_a_b.inverse();
    EXPECT_TRUE(moved.vector().isApprox(adjoint(T_a_b) * small, 1e-4));  // first order in `small`
  }
}

TEST_F(Pose2Laws, TransformsPointsAsTheMatrixDoes) {
  const Pose2 a = random_pose();
  const Eigen::Vector2d p(1.5, -2.0);
  const Eigen::Vector3d moved = matrix(a) * Eigen::Vector3d(p.x(), p.y(), 1.0);
  EXPECT_TRUE((a * p).isApprox(moved.head<2>(), 1e-12));
}

TEST(Pose2, ComposesAsTheRobotMoves) {
  // One metre forward, a quarter turn left, one metre forward.
  const Pose2 step{1.0, 0.0, std::numbers::pi / 2.0};
  const Pose2 end = step * Pose2{1.0, 0.0, 0.0};
  EXPECT_NEAR(end.x, 1.0, 1e-15);
  EXPECT_NEAR(end.y, 1.0, 1e-15);
}

}  // namespace
}  // namespace adit
