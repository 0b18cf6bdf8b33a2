// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/convex_polygon.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "common/geometry/ring.hpp"

namespace adit {
namespace {

/// The hull of points on a circle of 1 m and of more inside it, in random order.
ConvexPolygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  std::uniform_real_distribution<double> radius(0.0, 1.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 30; ++i) {
    const double bearing = angle(random);
    points.push_back(radius(random) * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
  }
  return ConvexPolygon(points);
}

Eigen::Vector2d random_point(std::mt19937& random, double reach_m = 1.5) {
  std::uniform_real_distribution<double> coordinate(-reach_m, reach_m);
  return {coordinate(random), coordinate(random)};
}

TEST(ConvexPolygon, ContainsThePointsThatItsRingEncloses) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    const ConvexPolygon polygon = random_polygon(random);
    ASSERT_GE(polygon.corners().size(), 3U);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d p = random_point(random);
      EXPECT_EQ(polygon.contains(p), encloses(polygon.corners(), p));
      EXPECT_EQ(polygon.contains(p), polygon.distance_m(p) == 0.0);
    }
  }
}

TEST(ConvexPolygon, DropsPointsInsideAndOnEdges) {
  const ConvexPolygon square({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 0}, {1, 2}});
  EXPECT_EQ(square.corners().size(), 4U);
  EXPECT_DOUBLE_EQ(square.area_m2(), 4.0);
  EXPECT_DOUBLE_EQ(square.radius_m(), std::sqrt(8.0));
}

TEST(ConvexPolygon, IsEmptyWithoutAnArea) {
  for (const std::vector<Eigen::Vector2d>& points : {std::vector<Eigen::Vector2d>{},
                                                     {{1, 1}},
                                                     {{1, 1}, {1, 1}, {1, 1}},
                                                     {{0, 0}, {1, 2}, {2, 4}}}) {
    const ConvexPolygon polygon(points);
    EXPECT_TRUE(polygon.empty());
    EXPECT_FALSE(polygon.contains({1.0, 1.0}));
    EXPECT_FALSE(polygon.meets_square({1.0, 1.0}, 1.0));
    EXPECT_TRUE(polygon.grown(1.0).empty());
    EXPECT_TRUE(polygon.boundary(0.1).empty());
  }
}

TEST(ConvexPolygon, HasTheDistanceOfItsNearestBoundaryPoint) {
  std::mt19937 random(2);
  constexpr double kSpacingM = 0.002;
  for (int round = 0; round < 20; ++round) {
    const ConvexPolygon polygon = random_polygon(random);
    const auto boundary = polygon.boundary(kSpacingM);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector2d p = random_point(random);
      if (polygon.contains(p)) continue;
      double nearest_m = 10.0;
      for (const Eigen::Vector2d& q : boundary) nearest_m = std::min(nearest_m, (q - p).norm());
      EXPECT_LE(polygon.distance_m(p), nearest_m + 1e-12);
      EXPECT_GE(polygon.distance_m(p), nearest_m - kSpacingM);
    }
  }
}

/// By points all over the square: it is met where the polygon contains one of them.
TEST(ConvexPolygon, MeetsTheSquaresThatShareAPointWithIt) {
  std::mt19937 random(3);
  constexpr double kHalfM = 0.2;
  constexpr int kSteps = 40;
  int met = 0;
  for (int round = 0; round < 300; ++round) {
    const ConvexPolygon polygon = random_polygon(random).moved({0.0, 0.0, 0.1 * round});
    const Eigen::Vector2d p = random_point(random);
    bool shares = false;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        const Eigen::Vector2d share(2.0 * i / kSteps - 1.0, 2.0 * k / kSteps - 1.0);
        shares = shares || polygon.contains(p + 0.999 * kHalfM * share);
      }
    }
    // Samples miss what reaches less than their spacing into the square.
    if (shares) {
      EXPECT_TRUE(polygon.meets_square(p, kHalfM));
    }
    if (!shares) {
      EXPECT_FALSE(polygon.meets_square(p, kHalfM - 2.0 * kHalfM / kSteps));
    }
    met += shares ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 250);
}

TEST(ConvexPolygon, GrowsByTheDistanceOfItsEdges) {
  const ConvexPolygon octagon(
      {{2, 0.5}, {1.5, 1}, {-1.5, 1}, {-2, 0.5}, {-2, -0.5}, {-1.5, -1}, {1.5, -1}, {2, -0.5}});
  const auto is_in = [](const Eigen::Vector2d& p, double by_m) {
    const Eigen::Vector2d q = p.cwiseAbs();
    return q.x() <= 2.0 + by_m && q.y() <= 1.0 + by_m &&
           q.sum() <= 2.5 + std::numbers::sqrt2 * by_m;
  };
  std::mt19937 random(4);
  for (const double by_m : {0.4, 0.05, 0.0, -0.05, -0.3, -0.8}) {
    const ConvexPolygon grown = octagon.grown(by_m);
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector2d p = random_point(random, 3.0);
      EXPECT_EQ(grown.contains(p), is_in(p, by_m)) << by_m << ": " << p.transpose();
    }
  }
  EXPECT_TRUE(octagon.grown(-1.0).empty());
}

TEST(ConvexPolygon, WidensByWhatItCoversOnTheMoveToEitherSide) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    const ConvexPolygon polygon = random_polygon(random);
    const ConvexPolygon widened = polygon.widened(0.3);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d p = random_point(random);
      bool covered = false;
      for (int k = -300; k <= 300; ++k)
        covered = covered || polygon.contains(p - Eigen::Vector2d(0.0, 0.001 * k));
      if (covered) {
        EXPECT_TRUE(widened.contains(p));
      }
      if (!covered) {
        EXPECT_FALSE(widened.grown(-0.002).contains(p));
      }
    }
  }
}

TEST(ConvexPolygon, KeepsItsBoundaryWithinTheSpacing) {
  const auto boundary = ConvexPolygon::rectangle({1.0, 0.0}, {1.2, 0.6}).boundary(0.1);
  EXPECT_EQ(boundary.size(), 72U);  // 24 and 12 along two sides each
  for (std::size_t i = 0; i < boundary.size(); ++i)
    EXPECT_NEAR((boundary[(i + 1) % boundary.size()] - boundary[i]).norm(), 0.1, 1e-9);
}

}  // namespace
}  // namespace adit
