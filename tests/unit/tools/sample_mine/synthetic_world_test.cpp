// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/synthetic_world.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

SyntheticWorld box(double half) {
  return SyntheticWorld({{{-half, -half}, {half, -half}},
                         {{half, -half}, {half, half}},
                         {{half, half}, {-half, half}},
                         {{-half, half}, {-half, -half}}});
}

TEST(SyntheticWorld, CastsOntoTheNearestWall) {
  const SyntheticWorld world = box(5.0);
  EXPECT_NEAR(world.cast({1.0, 0.0}, 0.0, 80.0).value(), 4.0, 1e-12);
  EXPECT_NEAR(world.cast({1.0, 0.0}, std::numbers::pi, 80.0).value(), 6.0, 1e-12);
  EXPECT_NEAR(world.cast({0.0, 0.0}, deg_to_rad(45.0), 80.0).value(), 5.0 * std::sqrt(2.0), 1e-9);
}

TEST(SyntheticWorld, SeesNothingBeyondItsRange) {
  EXPECT_FALSE(box(5.0).cast({0.0, 0.0}, 0.0, 4.99));
  EXPECT_FALSE(box(5.0).cast({20.0, 0.0}, 0.0, 80.0));
  EXPECT_FALSE(SyntheticWorld({}).cast({0.0, 0.0}, 0.0, 80.0));
}

TEST(SyntheticWorld, CastsFromOutside) {
  EXPECT_NEAR(box(5.0).cast({20.0, 0.3}, std::numbers::pi, 80.0).value(), 15.0, 1e-12);
}

TEST(SyntheticWorld, AgreesWithTestingEveryWall) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> metres(-20.0, 20.0);
  std::vector<Segment> walls;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d a(metres(random), metres(random));
    walls.push_back({a, a + 0.2 * Eigen::Vector2d(metres(random), metres(random))});
  }
  const SyntheticWorld world(walls);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(metres(random), metres(random));
    const double angle = metres(random);
    std::optional<double> expected;
    for (const Segment& wall : walls) {
      const auto single = SyntheticWorld({wall}).cast(p, angle, 30.0);
      if (single && (!expected || *single < *expected)) expected = single;
    }
    const auto range = world.cast(p, angle, 30.0);
    ASSERT_EQ(range.has_value(), expected.has_value());
    ASSERT_NEAR(range.value_or(0.0), expected.value_or(0.0), 1e-9);
  }
}

TEST(SyntheticWorld, MeasuresClearance) {
  EXPECT_NEAR(box(5.0).clearance({4.0, 1.0}, 2.0).value(), 1.0, 1e-12);
  EXPECT_FALSE(box(5.0).clearance({0.0, 0.0}, 2.0));
}

}  // namespace
}  // namespace adit
