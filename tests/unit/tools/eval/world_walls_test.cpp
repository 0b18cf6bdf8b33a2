// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/world_walls.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

TEST(WorldWalls, MeasuresDistancesToTheNearestWall) {
  const World world = box_tunnel({40.0, 4.0, 2.0});
  const WorldWalls walls(world, 5.0);
  EXPECT_NEAR(walls.distance_m({0.0, 0.0}), 2.0, 1e-9);
  EXPECT_NEAR(walls.distance_m({3.0, 1.5}), 0.5, 1e-9);
  EXPECT_NEAR(walls.distance_m({3.0, -2.5}), 0.5, 1e-9);  // outside the tunnel
  EXPECT_NEAR(walls.distance_m({23.0, 6.0}), 5.0, 1e-9);  // the corner
  EXPECT_TRUE(std::isinf(walls.distance_m({0.0, 8.0})));
}

TEST(WorldWalls, TallPartsAreWallsAndLowPartsAreNot) {
  const World world = box_tunnel({40.0, 4.0, 2.5}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kCar, Material::kSteel, "car");
    builder.box(level_box({5.0, 0.0, 0.5}, {2.0, 1.0, 1.0}));
    builder.begin_part(PartKind::kRail, Material::kSteel, "rail");
    builder.box(level_box({0.0, 0.0, 0.06}, {8.0, 0.05, 0.12}));
    builder.begin_part(PartKind::kCable, Material::kSteel, "cable under the roof");
    builder.box(level_box({-5.0, 0.0, 2.3}, {0.05, 2.0, 0.05}));
    builder.begin_part(PartKind::kWater, Material::kWater, "pool");
    builder.box(level_box({-10.0, 0.0, 0.3}, {2.0, 2.0, 0.1}));
  });
  const WorldWalls walls(world, 5.0);
  EXPECT_EQ(walls.distance_m({5.2, 0.3}), 0.0);  // on the car
  EXPECT_NEAR(walls.distance_m({3.0, 0.0}), 1.0, 1e-6);
  EXPECT_NEAR(walls.distance_m({-2.0, 0.0}), 2.0, 1e-6);
  EXPECT_NEAR(walls.distance_m({-5.0, 0.0}), 2.0, 1e-6);
  EXPECT_NEAR(walls.distance_m({-10.0, 0.0}), 2.0, 1e-6);
}

TEST(NearestPoints, AgreesWithAnExhaustiveSearch) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 200; ++i) points.emplace_back(place(random), place(random));
  const NearestPoints nearest(points, 0.3);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(place(random), place(random));
    double least = std::numeric_limits<double>::infinity();
    for (const auto& q : points) least = std::min(least, (p - q).norm());
    const double found = nearest.distance_m(p);
    if (least <= 0.3) {
      EXPECT_EQ(found, least);
    } else {
      EXPECT_TRUE(std::isinf(found));
    }
  }
}

TEST(DownsampledPoints, KeepsOnePointPerCell) {
  const std::vector<Eigen::Vector2d> selected = downsampled(
      std::vector<Eigen::Vector2d>{{0.01, 0.01}, {0.09, 0.05}, {-0.01, 0.01}, {0.3, 0.3}}, 0.1);
  ASSERT_EQ(selected.size(), 3U);
  EXPECT_EQ(selected[0], Eigen::Vector2d(0.01, 0.01));
}

}  // namespace
}  // namespace adit
