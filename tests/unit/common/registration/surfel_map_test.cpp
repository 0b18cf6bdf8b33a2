// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surfel_map.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr Pose2 kOrigin{};

SurfacePoint point(double x, double y, const Eigen::Vector2d& normal = {0.0, 0.0}) {
  SurfacePoint p;
  p.p = {x, y};
  p.normal = normal;
  p.normal_variance = 1e-4;
  p.variance = 1e-4;
  return p;
}

TEST(SurfelMap, FindsTheSameNearestSurfelAsExhaustiveSearch) {
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
    const Surfel* found = map.nearest(p, {0.0, 0.0}, SurfelMap::kReach).surfel;
    if (best < SurfelMap::kReach) {
      ASSERT_NE(found, nullptr);
      EXPECT_NEAR((found->p - p).norm(), best, 1e-12);
    } else {
      EXPECT_EQ(found, nullptr);
    }
  }
}

TEST(SurfelMap, ReportsTheClearanceWithinWhichTheResultHolds) {
  SurfelMap map{SurfelMapParams{}};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> metres(-2.0, 2.0);
  std::uniform_real_distribution<double> radians(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < 40; ++i) map.insert({point(metres(random), metres(random))}, kOrigin, 0.0);
  for (const double radius : {0.1, 0.25, 0.4, SurfelMap::kReach}) {
    int nothing = 0;
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector2d p(metres(random), metres(random));
      const auto [surfel, clearance] = map.nearest(p, {0.0, 0.0}, radius);
      ASSERT_GE(clearance, 0.0);
      const double angle = radians(random);
      const Eigen::Vector2d moved =
          p + 0.999 * clearance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Surfel* now = map.nearest(moved, {0.0, 0.0}, SurfelMap::kReach).surfel;
      const auto away = [&](const Surfel& s) { return (s.p - moved).norm(); };
      if (surfel != nullptr && away(*surfel) < SurfelMap::kReach) {
        ASSERT_EQ(now, surfel);
      } else if (surfel == nullptr) {
        ++nothing;
        ASSERT_TRUE(now == nullptr || away(*now) >= radius);
      }
    }
    EXPECT_GT(nothing, 0);
  }
}

TEST(SurfelMap, AveragesRepeatedObservationsAlongTheNormal) {
  SurfelMap map{SurfelMapParams{}};
  for (const double offset : {0.01, -0.01, 0.02, -0.02}) {
    map.insert({point(1.0, offset, {0.0, -1.0})}, kOrigin, 0.0);
  }
  ASSERT_EQ(map.surfels().size(), 1U);
  EXPECT_NEAR(map.surfels()[0].p.y(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(map.surfels()[0].p.x(), 1.0);
  EXPECT_NEAR(map.surfels()[0].variance, 1e-4 / 4, 1e-9);
}

TEST(SurfelMap, SeparatesTheTwoSidesOfAThinWall) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0, {0.0, -1.0}), point(1.0, 0.02, {0.0, 1.0})}, kOrigin, 0.0);
  EXPECT_EQ(map.surfels().size(), 2U);
  EXPECT_GT(map.nearest({1.0, 0.0}, {0.0, 1.0}, 0.5).surfel->normal.y(), 0.0);
}

TEST(SurfelMap, TakesForSteepWhatWasObservedInOnePlaceAtDifferentHeights) {
  SurfelMap map{SurfelMapParams{}};
  const auto observe = [&](double x, double z_m) {
    SurfacePoint observed = point(x, 0.0, {0.0, -1.0});
    observed.z_m = z_m;
    map.insert({observed}, kOrigin, 0.0);
  };
  observe(1.0, 0.6);
  EXPECT_FALSE(map.surfels()[0].is_steep());
  observe(1.0, 0.75);
  observe(1.0, 0.46);
  ASSERT_EQ(map.surfels().size(), 1U);
  EXPECT_FALSE(map.surfels()[0].is_steep());  // 0.29 m
  observe(1.0, 0.44);
  EXPECT_TRUE(map.surfels()[0].is_steep());
  EXPECT_DOUBLE_EQ(map.surfels()[0].z_min_m, 0.44);
  EXPECT_DOUBLE_EQ(map.surfels()[0].z_max_m, 0.75);
  observe(1.0, 0.6);
  EXPECT_TRUE(map.surfels()[0].is_steep());
  // Ground that rises by 20 %: what is 0.2 m higher is 1 m farther.
  observe(2.0, 0.6);
  observe(3.0, 0.8);
  ASSERT_EQ(map.surfels().size(), 3U);
  EXPECT_FALSE(map.surfels()[1].is_steep());
  EXPECT_FALSE(map.surfels()[2].is_steep());
}

TEST(SurfelMap, TransformsPointsByThePose) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0, {-1.0, 0.0})}, {2.0, 3.0, std::numbers::pi / 2}, 0.0);
  EXPECT_NEAR(map.surfels()[0].p.x(), 2.0, 1e-12);
  EXPECT_NEAR(map.surfels()[0].p.y(), 4.0, 1e-12);
  EXPECT_NEAR(map.surfels()[0].normal.y(), -1.0, 1e-12);
}

TEST(SurfelMap, RemovesSurfelsNotObservedForALongDistance) {
  SurfelMap map{SurfelMapParams{}};
  map.insert({point(1.0, 0.0), point(2.0, 0.0)}, kOrigin, 0.0);
  map.insert({point(2.0, 0.0)}, kOrigin, 10.0);
  map.remove_before(5.0);
  EXPECT_EQ(map.nearest({1.0, 0.0}, {0.0, 0.0}, 0.5).surfel, nullptr);
  EXPECT_NE(map.nearest({2.0, 0.0}, {0.0, 0.0}, 0.5).surfel, nullptr);
}

TEST(SurfelMap, DistinguishesPlacesOneGridLengthApart) {
  SurfelMap map{SurfelMapParams{}};
  const double period = 512 * SurfelMap::kBucket;
  map.insert({point(1.0, 1.0)}, kOrigin, 0.0);
  EXPECT_EQ(map.nearest({1.0 + period, 1.0}, {0.0, 0.0}, 0.5).surfel, nullptr);
}

}  // namespace
}  // namespace adit
