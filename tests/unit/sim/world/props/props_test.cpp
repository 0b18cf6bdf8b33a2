// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/props/outlines.hpp"
#include "sim/world/props/prop_site.hpp"
#include "tests/unit/sim/world/props/prop_scene.hpp"

namespace adit {
namespace {

/// Distance of a point from a convex outline; 0 or less inside.
double outside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
  double farthest = -1e9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    const Eigen::Vector2d to_p = p - outline[i];
    farthest = std::max(farthest, (edge.y() * to_p.x() - edge.x() * to_p.y()) / edge.norm());
  }
  return farthest;
}

PropDescriptions one_of_each() {
  PropDescriptions props;
  props.posts.push_back({.tunnel = "bent", .from_m = 3.0, .to_m = 9.0});
  props.cribs.push_back({.tunnel = "bent", .at_m = 12.0});
  props.rubble.push_back({.tunnel = "bent", .at_m = 35.0});
  props.beams.push_back({.tunnel = "bent", .at_m = 25.0});
  props.cars.push_back({.tunnel = "bent", .at_m = 45.0});
  props.water.push_back({.name = "pool", .tunnel = "main", .from_m = 20.0, .to_m = 40.0});
  return props;
}

TEST(Obstacles, ContainAllVerticesOfTheirPart) {
  const PropScene scene(one_of_each());
  const TriangleMesh& mesh = scene.world.mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Obstacle* obstacle = scene.obstacle(mesh.part_of(t).name);
    ASSERT_NE(obstacle, nullptr) << mesh.part_of(t).name;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Eigen::Vector3d p = mesh.vertices[v].cast<double>();
      EXPECT_LE(outside(obstacle->outline, p.head<2>()), 1e-5) << obstacle->name;  // float
      EXPECT_LE(p.z(), obstacle->z_high_m + 1e-6);
      EXPECT_GE(p.z(), obstacle->z_low_m - (obstacle->kind == PartKind::kWater ? 1.0 : 1e-6));
    }
  }
}

TEST(Obstacles, HaveConvexOutlinesThatRunCounterClockwise) {
  const PropScene scene(one_of_each());
  for (const Obstacle& obstacle : scene.world.truth.obstacles) {
    ASSERT_GE(obstacle.outline.size(), 3U);
    for (const Eigen::Vector2d& corner : obstacle.outline) {
      EXPECT_LE(outside(obstacle.outline, corner), 1e-9) << obstacle.name;
    }
  }
}

TEST(ConvexOutline, IsTheSquareAroundPointsInIt) {
  const std::vector<Eigen::Vector2d> points{{0, 0}, {1, 1}, {0.5, 0.5}, {1, 0}, {0, 1}, {0.5, 0}};
  EXPECT_THAT(convex_outline(points),
              testing::ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0),
                                   Eigen::Vector2d(1, 1), Eigen::Vector2d(0, 1)));
}

TEST(Stones, AreConvexClosedAndWithinTheirRadius) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    MeshBuilder builder;
    builder.begin_part(PartKind::kRubble, Material::kRock, "stone");
    const Eigen::Vector3d middle(1.0, 2.0, 0.3);
    add_stone(middle, 0.3, random, builder);
    const TriangleMesh& mesh = builder.mesh();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
      const Eigen::Vector3f normal =
          (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
      for (const Eigen::Vector3f& p : mesh.vertices) {
        EXPECT_LE(normal.normalized().dot(p - mesh.vertices[a]), 1e-5F);  // single precision
      }
    }
    for (const auto& [edge, times] : edges) {
      EXPECT_EQ(times, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
    for (const Eigen::Vector3f& p : mesh.vertices) {
      EXPECT_LE((p.cast<double>() - middle).norm(), 0.3 + 1e-5);
    }
  }
}

std::string error_of(const PropDescriptions& props) {
  try {
    const PropScene scene(props);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Props, InAnUnknownTunnelAreRejectedByName) {
  PropDescriptions props = one_of_each();
  props.posts.push_back({.tunnel = "mian", .from_m = 3.0});
  EXPECT_THAT(error_of(props), testing::StartsWith("props.posts[1] is in tunnel 'mian'"));
  props = {};
  props.water.push_back({.name = "pool", .tunnel = "mian", .from_m = 1.0, .to_m = 2.0});
  EXPECT_THAT(error_of(props), testing::StartsWith("props.water[0] is in tunnel 'mian'"));
}

TEST(Props, BeyondTheEndOfTheirTunnelAreRejectedByName) {
  PropDescriptions props;
  props.beams.push_back({.tunnel = "main", .at_m = 60.5});
  EXPECT_EQ(error_of(props),
            "props.beams[0]: 60.5 m is not along tunnel 'main', which is 60 m long");
  props = {};
  props.low_roofs.push_back({.name = "low", .tunnel = "main", .from_m = 50.0, .to_m = 61.0});
  EXPECT_THAT(error_of(props), testing::StartsWith("props.low_roofs[0]: 61 m is not along"));
}

TEST(Props, ThatEndBeforeTheyBeginAreRejectedByName) {
  PropDescriptions props;
  props.rails.push_back({.tunnel = "main", .from_m = 50.0, .to_m = 40.0});
  EXPECT_EQ(error_of(props), "props.rails[0]: ends at 40 m, and begins at 50 m");
}

}  // namespace
}  // namespace adit
