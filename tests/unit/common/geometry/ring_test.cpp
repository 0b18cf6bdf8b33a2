// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/ring.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(Ring, EnclosesPointsOfAConcaveOutline) {
  const std::vector<Eigen::Vector2d> ring{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_TRUE(encloses(ring, {0.5, 2.5}));
  EXPECT_TRUE(encloses(ring, {2.5, 0.5}));
  EXPECT_FALSE(encloses(ring, {2.0, 2.0}));
  EXPECT_FALSE(encloses(ring, {-0.5, 1.0}));  // beside corners at the same height
  EXPECT_FALSE(encloses(ring, {3.5, 1.0}));
  EXPECT_FALSE(encloses({}, {0.0, 0.0}));
}

/// Of an ellipse with many corners: the closed form tells.
TEST(Ring, AgreesWithTheClosedFormWhetherItsFirstPointIsRepeatedOrNot) {
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 1000.0;
    ring.emplace_back(3.0 * std::cos(angle), 2.0 * std::sin(angle));
  }
  auto closed = ring;
  closed.push_back(ring.front());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-4.0, 4.0);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(coordinate(random), coordinate(random));
    const double radius = std::hypot(p.x() / 3.0, p.y() / 2.0);
    if (std::abs(radius - 1.0) < 1e-4) continue;
    EXPECT_EQ(encloses(ring, p), radius < 1.0);
    EXPECT_EQ(encloses(closed, p), radius < 1.0);
  }
}

}  // namespace
}  // namespace adit
