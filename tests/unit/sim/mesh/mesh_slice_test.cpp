// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_slice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

double area(const std::vector<Eigen::Vector2d>& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2.0;
}

TEST(MeshSlice, OfABoxIsItsRectangle) {
  const World world = box_tunnel({.length_m = 40.0, .width_m = 4.0, .height_m = 2.0});
  const auto loops = slice(world.mesh, 0.6);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_NEAR(area(loops[0]), 160.0, 1e-4);  // the mesh is in single precision
  for (const Eigen::Vector2d& p : loops[0]) {
    EXPECT_TRUE(std::abs(std::abs(p.x()) - 20.0) < 1e-6 || std::abs(std::abs(p.y()) - 2.0) < 1e-6);
  }
}

TEST(MeshSlice, AboveAndBelowIsEmpty) {
  const World world = box_tunnel();
  EXPECT_TRUE(slice(world.mesh, -0.1).empty());
  EXPECT_TRUE(slice(world.mesh, 2.1).empty());
}

TEST(MeshSlice, ObjectsHaveTheirOwnLoops) {
  const World world = box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kCrib, Material::kTimber, "crib");
    builder.box(level_box({3.0, 0.0, 1.0}, {1.0, 0.5, 1.9}));
  });
  const auto loops = slice(world.mesh, 0.6);
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_NEAR(std::min(area(loops[0]), area(loops[1])), 0.5, 1e-5);
}

TEST(MeshSlice, DropsOpenLines) {
  World world = box_tunnel();
  world.mesh.triangles.pop_back();  // of a wall
  world.mesh.triangle_parts.pop_back();
  EXPECT_TRUE(slice(world.mesh, 0.6).empty());
}

TEST(MeshSlice, MergesCoincidentVertices) {
  const World world = box_tunnel();
  TriangleMesh soup;
  for (const TriangleMesh::Triangle& triangle : world.mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t i : triangle) soup.vertices.push_back(world.mesh.vertices[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  ASSERT_EQ(slice(soup, 0.6).size(), 1U);
}

TEST(MeshSlice, HandlesVerticesOnThePlaneAndNotFiniteOnes) {
  World world = box_tunnel();
  const auto n = static_cast<std::uint32_t>(world.mesh.vertices.size());
  world.mesh.vertices.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  world.mesh.triangles.push_back({0, 4, n});
  EXPECT_EQ(slice(world.mesh, 0.6).size(), 1U);
  EXPECT_EQ(slice(world.mesh, 0.0).size(), 1U);  // the floor itself counts as below
}

}  // namespace
}  // namespace adit
