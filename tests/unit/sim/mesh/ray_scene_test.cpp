// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/ray_scene.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/worlds/box_tunnel.hpp"
#include "tests/support/worlds/rough_mine.hpp"

namespace adit {
namespace {

constexpr float kFar = 100.0F;

Ray ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  return {origin.cast<float>(), direction.normalized().cast<float>()};
}

TEST(RayScene, HitsTheNearestSurface) {
  const World world = box_tunnel({40.0, 4.0, 2.0});
  const RayScene scene(world.mesh);
  const auto wall = scene.cast(ray({0.0, 0.5, 1.0}, {0.0, 1.0, 0.0}), kFar);
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->distance_m, 1.5, 1e-5);
  EXPECT_EQ(world.mesh.part_of(wall->triangle).name, "walls");
  EXPECT_NEAR(wall->normal.y(), -1.0, 1e-6);

  const auto floor = scene.cast(ray({3.0, 0.0, 1.0}, {1.0, 0.0, -1.0}), kFar);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->distance_m, std::sqrt(2.0), 1e-5);
  EXPECT_EQ(world.mesh.part_of(floor->triangle).kind, PartKind::kFloor);
}

TEST(RayScene, HitsNothingBeyondTheRange) {
  const World world = box_tunnel();
  const RayScene scene(world.mesh);
  EXPECT_FALSE(scene.cast(ray({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}), 19.0F));
  EXPECT_TRUE(scene.cast(ray({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}), 21.0F));
}

TEST(RayScene, BatchesOfRaysAgreeWithSingleRays) {
  const World world = box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kPost, Material::kTimber, "post");
    builder.bar({3.0, 1.0, 0.0}, {3.0, 1.0, 2.0}, 0.1);
  });
  const RayScene scene(world.mesh);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Ray> rays;
  for (int i = 0; i < 1003; ++i) {
    rays.push_back(ray({0.0, 0.0, 1.0}, {normal(random), normal(random), normal(random)}));
  }
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, 15.0F, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto one = scene.cast(rays[i], 15.0F);
    EXPECT_EQ(one.has_value(), std::isfinite(hits[i].distance_m)) << i;
    if (one) {
      EXPECT_NEAR(one->distance_m, hits[i].distance_m, 1e-4) << i;
    }
  }
}

TEST(RayScene, MissesNoRayOfAFan) {
  const TriangleMesh mesh = rough_mine();
  const RayScene scene(mesh);
  std::vector<RayHit> hits(361);
  for (int k = 0; k < 100; ++k) {
    const Eigen::AngleAxisd tilt(0.01 * k - 0.5, Eigen::Vector3d::UnitY());
    std::vector<Ray> rays;
    for (int i = 0; i < 361; ++i) {
      const double angle = deg_to_rad(0.5 * i - 90.0);
      rays.push_back(ray({3.0 + 0.05 * k, 1.5, 0.7},
                         tilt * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)));
    }
    scene.cast(rays, kFar, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto one = scene.cast(rays[i], kFar);
      EXPECT_NEAR(one ? one->distance_m : kFar, std::min(hits[i].distance_m, kFar), 1e-4) << i;
    }
  }
}

TEST(RayScene, WaterIsInTheOpticalLayerOnly) {
  const World world = box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWater, Material::kWater, "water");
    builder.box(level_box({0.0, 0.0, 0.3}, {4.0, 4.0, 0.2}));
  });
  const RayScene scene(world.mesh);
  const Ray down = ray({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0});
  EXPECT_NEAR(scene.cast(down, kFar)->distance_m, 0.6, 1e-5);
  EXPECT_NEAR(scene.cast(down, kFar, RayScene::Layer::kSolid)->distance_m, 1.0, 1e-5);
  // Among many: one over the water, one beside it.
  const std::vector<Ray> rays{down, ray({5.0, 0.0, 1.0}, {0.0, 0.0, -1.0})};
  std::vector<RayHit> hits(rays.size());
  scene.cast(rays, kFar, hits, RayScene::Layer::kSolid);
  EXPECT_NEAR(hits[0].distance_m, 1.0, 1e-5);
  EXPECT_NEAR(hits[1].distance_m, 1.0, 1e-5);
  EXPECT_EQ(world.mesh.part_of(hits[0].triangle).kind, PartKind::kFloor);
  scene.cast(rays, 0.9F, hits, RayScene::Layer::kSolid);
  EXPECT_TRUE(std::isinf(hits[0].distance_m));
  EXPECT_THAT(scene.touching(level_box({0.0, 0.0, 0.3}, {1.0, 1.0, 0.4})), testing::IsEmpty());
}

TEST(RayScene, FindsTheTrianglesThatABoxTouches) {
  const World world = box_tunnel({40.0, 4.0, 2.0}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kCable, Material::kSteel, "cable");
    builder.bar({5.0, -2.0, 1.0}, {5.0, 2.0, 1.0}, 0.015);
  });
  const RayScene scene(world.mesh);
  EXPECT_THAT(scene.touching(level_box({3.5, 0.0, 1.0}, {2.9, 1.0, 1.0})), testing::IsEmpty());
  const auto touched = scene.touching(level_box({3.5, 0.0, 1.0}, {3.0, 1.0, 1.0}));
  ASSERT_THAT(touched, testing::Not(testing::IsEmpty()));
  for (const std::uint32_t triangle : touched) {
    EXPECT_EQ(world.mesh.part_of(triangle).name, "cable");
  }
}

TEST(RayScene, AcceptsAnEmptyMesh) {
  const TriangleMesh nothing;
  const RayScene scene(nothing);
  EXPECT_FALSE(scene.cast(ray({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}), kFar));
  EXPECT_THAT(scene.touching(level_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0})), testing::IsEmpty());
}

}  // namespace
namespace {

/// Whether one of many points of the triangle is in the box: a sufficient condition for overlap.
bool has_a_point_inside(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle) {
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const Eigen::Vector3d p = triangle[0] + (triangle[1] - triangle[0]) * i / kSteps +
                                (triangle[2] - triangle[0]) * j / kSteps;
      const Eigen::Vector3d p_box = box.T_world_box.inverse() * p;
      if ((p_box.cwiseAbs() - box.half_size).maxCoeff() <= 0.0) return true;
    }
  }
  return false;
}

TEST(BoxOverlap, AgreesWithPointsOfTheTriangle) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  const auto point = [&] {
    return Eigen::Vector3d(anywhere(random), anywhere(random), anywhere(random));
  };
  int touching = 0;
  int missed = 0;  // by the points: they leave gaps of a fortieth of an edge
  for (int i = 0; i < 2000; ++i) {
    OrientedBox box;
    box.T_world_box.translation() = 0.5 * point();
    box.T_world_box.linear() =
        Eigen::AngleAxisd(anywhere(random), point().normalized()).toRotationMatrix();
    box.half_size = 0.4 * point().cwiseAbs();
    const std::array<Eigen::Vector3d, 3> triangle{point(), point(), point()};
    const bool inside = has_a_point_inside(box, triangle);
    const bool overlap = overlaps(box, triangle);
    EXPECT_TRUE(overlap || !inside) << i;
    touching += overlap ? 1 : 0;
    missed += overlap && !inside ? 1 : 0;
  }
  EXPECT_GT(touching, 500);
  EXPECT_LT(missed, 0.15 * touching);
}

TEST(BoxOverlap, IsFalseForVerticesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OrientedBox box;
  box.half_size = {1.0, 1.0, 1.0};
  EXPECT_FALSE(overlaps(box, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {nan, 0.0, 0.0}}}));
}

}  // namespace
}  // namespace adit
