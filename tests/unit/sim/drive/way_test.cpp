// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/way.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kExact = 1e-12;

/// 3 m along x, then 4 m along y, then 3 m back along x at a distance of 4 m.
LeggedWay hook() { return LeggedWay({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}, {0.0, 4.0}}); }

TEST(LeggedWay, CountsAlongItsLegsAndGoesOnBehindTheEnd) {
  const LeggedWay way = hook();
  EXPECT_DOUBLE_EQ(way.length_m(), 10.0);
  EXPECT_TRUE(way.at(2.0).isApprox(Eigen::Vector2d(2.0, 0.0), kExact));
  EXPECT_TRUE(way.at(5.0).isApprox(Eigen::Vector2d(3.0, 2.0), kExact));
  EXPECT_TRUE(way.at(12.0).isApprox(Eigen::Vector2d(-2.0, 4.0), kExact));
  EXPECT_EQ(way.leg(-1.0), 0U);
  EXPECT_EQ(way.leg(3.0), 1U);
  EXPECT_EQ(way.leg(99.0), 2U);
  EXPECT_NEAR(way.heading_rad(1), std::numbers::pi / 2.0, kExact);
}

TEST(LeggedWay, FindsTheNearestPlaceBetweenTwo) {
  const LeggedWay way = hook();
  const Eigen::Vector2d p(1.0, 2.5);  // nearest to the last leg
  EXPECT_NEAR(way.nearest_m(p, 0.0, 10.0), 9.0, kExact);
  EXPECT_NEAR(way.nearest_m(p, 0.0, 6.0), 5.5, kExact);
  EXPECT_NEAR(way.nearest_m(p, 0.0, 2.0), 1.0, kExact);
  EXPECT_NEAR(way.nearest_m(p, 2.0, 2.5), 2.0, kExact);
}

}  // namespace
}  // namespace adit
