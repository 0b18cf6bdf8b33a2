// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/polyline.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Polyline, InterpolatesAlongItsLength) {
  const Polyline line({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}});
  EXPECT_DOUBLE_EQ(line.length_m(), 7.0);
  EXPECT_EQ(line.at(1.0), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(line.at(5.0), Eigen::Vector2d(3.0, 2.0));
  EXPECT_EQ(line.at(-1.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(line.at(9.0), Eigen::Vector2d(3.0, 4.0));
}

TEST(Polyline, HasADirectionAtItsEndsAndBends) {
  const Polyline line({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}});
  EXPECT_EQ(line.chord_at(0.0, 1.0), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(line.chord_at(3.0, 1.0), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(Polyline({{1.0, 1.0}}).chord_at(0.0, 1.0), Eigen::Vector2d(0.0, 0.0));
}

/// Where a line crosses itself, the part of it decides.
TEST(Polyline, FindsTheNearestPlaceOfAPart) {
  const Polyline line({{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}, {5.0, 5.0}, {5.0, -5.0}});
  const Eigen::Vector2d crossing(5.0, 0.5);
  EXPECT_NEAR(line.nearest(crossing, 0.0, 8.0).at_m, 5.0, 1e-12);
  EXPECT_NEAR(line.nearest(crossing, 0.0, 8.0).beside_m, 0.5, 1e-12);
  EXPECT_NEAR(line.nearest(crossing, 20.0, 30.0).at_m, 24.5, 1e-12);
  EXPECT_NEAR(line.nearest(crossing, 20.0, 30.0).beside_m, 0.0, 1e-12);
  EXPECT_NEAR(line.nearest({20.0, 1.0}, 2.0, 6.0).at_m, 6.0, 1e-12);
  EXPECT_TRUE(std::isinf(Polyline({{1.0, 1.0}}).nearest(crossing, 0.0, 1.0).beside_m));
}

}  // namespace
}  // namespace adit
