// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/attitude.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Attitude, RaisesTheLeftSideByRollAndLowersTheFrontByPitch) {
  const Eigen::Vector3d left = Attitude{0.1, 0.0}.rotation() * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(left.z(), std::sin(0.1), 1e-12);
  const Eigen::Vector3d ahead = Attitude{0.0, 0.1}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.z(), -std::sin(0.1), 1e-12);
}

TEST(Attitude, KeepsTheHeadingOfTheBody) {
  const Eigen::Vector3d ahead = Attitude{0.2, -0.3}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
  EXPECT_GT(ahead.x(), 0.0);
}

TEST(Attitude, ReturnsFromTheVerticalInTheBodyFrame) {
  for (const Attitude attitude : {Attitude{0.3, -0.2}, {-0.5, 0.4}, {0.0, 0.0}}) {
    const Attitude back = Attitude::from_up(3.0 * attitude.up_body());
    EXPECT_NEAR(back.roll_rad, attitude.roll_rad, 1e-12);
    EXPECT_NEAR(back.pitch_rad, attitude.pitch_rad, 1e-12);
  }
}

/// Against the rotation after a short time.
TEST(HeadingRate, IsThatAboutTheVertical) {
  constexpr double kStepS = 1e-6;
  const Eigen::Vector3d rates(0.3, -0.2, 0.5);
  for (const Attitude attitude : {Attitude{0.3, -0.2}, {-0.1, 0.5}, {0.0, 0.0}}) {
    const Eigen::AngleAxisd turn(kStepS * rates.norm(), rates.normalized());
    const Eigen::Vector3d ahead = attitude.rotation() * (turn * Eigen::Vector3d::UnitX());
    EXPECT_NEAR(heading_rate_rad_s(attitude, rates), std::atan2(ahead.y(), ahead.x()) / kStepS,
                1e-5);
  }
}

TEST(GroundSlope, RisesAheadOfABodyWhoseFrontIsRaised) {
  const Eigen::Vector2d slope = ground_slope({0.0, -std::atan(0.2)});
  EXPECT_NEAR(slope.x(), 0.2, 1e-12);
  EXPECT_NEAR(slope.y(), 0.0, 1e-12);
  EXPECT_NEAR(ground_slope({std::atan(0.1), 0.0}).y(), 0.1, 1e-12);
}

}  // namespace
}  // namespace adit
