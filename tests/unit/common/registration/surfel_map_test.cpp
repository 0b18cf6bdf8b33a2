// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surfel_map.hpp"

#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr Pose2 kOrigin{};

SurfacePoint point(double x, double y, Eigen::Vector2d normal = {0.0, 0.0}) {
  SurfacePoint p;
  p.p = {x, y};
  p.normal = normal;
  p.normal_variance = 1e-4;
  p.variance = 1e-4;
  return p;
}

TEST(SurfelMap, FindsTheNearestAsExhaustiveSearchDoes) {
  SurfelMap map{SurfelMapParams{}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> metres(-3.0, 3.0);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 300; ++i) points.push_back(point(metres(random), metres(random)));
  map.insert(points, kOrigin, 0.0);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(metres(random), metres(random));
    double best = SurfelMap::kReach;
    for (const auto& surfel : map.surfels()) best = std::min(best, (surfel.p - p).norm());
    const Surfel* found = map.nearest(p, {0.0, 0.0}, SurfelMap::kReach);
    if (best < SurfelMap::kReach) {
      ASSERT_NE(found, nullptr);
      EXPECT_NEAR((found->p - p).norm(), best, 1e-12);
    } else {
      EXPECT_EQ(found, nullptr);
    }
  }
}

TEST(SurfelMap, AveragesWhatItSeesAgainAlongTheNormal) {
  SurfelMap map{SurfelMapParams{}};
  for (const double offset : {0.01, -0.01, 0.02, -0.02}) {
    map.insert({point(1.0, offset, {0.0, -1.0})}, kOrigin, 0.0);
  }
  ASSERT_EQ(map.surfels().size(), 1U);
  EXPECT_NEAR(map.surfels()[0].p.y(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(map.surfels()[0].p.x(), 1.0);
  EXPECT_NEAR(map.surfels()[0].variance, 1e-4 / 4, 1e-9);
}

TEST(SurfelMap, KeepsTheTwoSidesOfAThinWallApart) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0, {0.0, -1.0}), point(1.0, 0.02, {0.0, 1.0})}, kOrigin, 0.0);
  EXPECT_EQ(map.surfels().size(), 2U);
  EXPECT_GT(map.nearest({1.0, 0.0}, {0.0, 1.0}, 0.5)->normal.y(), 0.0);
}

TEST(SurfelMap, PlacesPointsByThePose) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0, {-1.0, 0.0})}, {2.0, 3.0, std::numbers::pi / 2}, 0.0);
  EXPECT_NEAR(map.surfels()[0].p.x(), 2.0, 1e-12);
  EXPECT_NEAR(map.surfels()[0].p.y(), 4.0, 1e-12);
  EXPECT_NEAR(map.surfels()[0].normal.y(), -1.0, 1e-12);
}

TEST(SurfelMap, ForgetsWhatWasNotSeenForLong) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0), point(2.0, 0.0)}, kOrigin, 0.0);
  map.insert({point(2.0, 0.0)}, kOrigin, 10.0);
  map.forget_before(5.0);
  EXPECT_EQ(map.nearest({1.0, 0.0}, {0.0, 0.0}, 0.5), nullptr);
  EXPECT_NE(map.nearest({2.0, 0.0}, {0.0, 0.0}, 0.5), nullptr);
}

TEST(SurfelMap, IsNotConfusedByPlacesAWholeGridAway) {
  SurfelMap map{SurfelMapParams{}};
  const double period = 512 * SurfelMap::kBucket;
  map.insert({point(1.0, 1.0)}, kOrigin, 0.0);
  EXPECT_EQ(map.nearest({1.0 + period, 1.0}, {0.0, 0.0}, 0.5), nullptr);
}

}  // namespace
}  // namespace adit
