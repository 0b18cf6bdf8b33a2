// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/segment.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Segment, HasTheNearestPointToAPlace) {
  const Segment2 segment{{0.0, 0.0}, {4.0, 0.0}};
  EXPECT_EQ(nearest_point(segment, {1.0, 3.0}), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(nearest_point(segment, {-2.0, 1.0}), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(nearest_point(segment, {9.0, -1.0}), Eigen::Vector2d(4.0, 0.0));
  EXPECT_EQ(nearest_point({{1.0, 1.0}, {1.0, 1.0}}, {5.0, 5.0}), Eigen::Vector2d(1.0, 1.0));
}

TEST(Segment, MeetsAnotherWhereTheyCross) {
  const ClosestPair points = nearest_points({{0.0, 0.0}, {4.0, 4.0}}, {{0.0, 4.0}, {4.0, 0.0}});
  EXPECT_NEAR((points.on_a - Eigen::Vector2d(2.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(points.distance(), 0.0);
}

/// By trying points of both.
TEST(Segment, IsAsNearToAnotherAsAnyPairOfPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto point = [&] { return Eigen::Vector2d(place(random), place(random)); };
  for (int i = 0; i < 200; ++i) {
    const Segment2 a{point(), point()};
    const Segment2 b{point(), i % 10 == 0 ? a.from : point()};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 200; ++k) {
      const Eigen::Vector2d p = a.from + (k / 200.0) * (a.to - a.from);
      least = std::min(least, (nearest_point(b, p) - p).norm());
    }
    const double distance = nearest_points(a, b).distance();
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 0.015);
  }
}

}  // namespace
}  // namespace adit
