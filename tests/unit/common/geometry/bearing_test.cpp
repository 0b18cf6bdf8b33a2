// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/bearing.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Bearing, IsThatOfTheStandardLibrary) {
  for (int i = 0; i < 100000; ++i) {
    const double angle = std::numbers::pi * (i - 50000) / 50000.0;
    const double distance = 1e-3 * std::exp2(i % 20);
    const Eigen::Vector2d p(distance * std::cos(angle), distance * std::sin(angle));
    EXPECT_NEAR(bearing_of(p), std::atan2(p.y(), p.x()), 2e-8) << angle;
  }
}

TEST(Bearing, AlongTheAxes) {
  EXPECT_EQ(bearing_of({2.0, 0.0}), 0.0);
  EXPECT_EQ(bearing_of({0.0, 2.0}), std::numbers::pi / 2.0);
  EXPECT_EQ(bearing_of({-2.0, 0.0}), std::numbers::pi);
  EXPECT_EQ(bearing_of({0.0, -2.0}), -std::numbers::pi / 2.0);
  EXPECT_EQ(bearing_of({0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace adit
