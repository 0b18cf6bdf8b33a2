// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/angle.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Angle, WrapsIntoTheHalfOpenIntervalThatHoldsPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi / 2.0), -kPi / 2.0, 1e-15);
  EXPECT_NEAR(wrap_angle(-7.0), -7.0 + 2.0 * kPi, 1e-15);
  EXPECT_DOUBLE_EQ(wrap_angle(0.0), 0.0);
}

TEST(Angle, DifferenceTakesTheShortWayAround) {
  EXPECT_NEAR(angle_diff(deg_to_rad(179.0), deg_to_rad(-179.0)), deg_to_rad(-2.0), 1e-12);
  EXPECT_NEAR(angle_diff(deg_to_rad(-179.0), deg_to_rad(179.0)), deg_to_rad(2.0), 1e-12);
}

TEST(Angle, DegreesAndRadiansAreInverse) { EXPECT_DOUBLE_EQ(rad_to_deg(deg_to_rad(37.5)), 37.5); }

}  // namespace
}  // namespace adit
