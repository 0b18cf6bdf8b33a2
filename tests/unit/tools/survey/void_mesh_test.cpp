// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/mesh/void_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/mesh/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/survey/survey_scene.hpp"

namespace adit {
namespace {

/// A tunnel of 4 m by 2.2 m from x = −4 to 4; with `ends` closed by faces.
Cloud tunnel(bool ends) {
  Cloud cloud = test::scan_of_tunnel(-4.0, 4.0, {2.0, 2.2});
  if (!ends) return cloud;
  for (const float x : {-4.0F, 4.0F}) {
    for (float y = -1.95F; y < 2.0F; y += 0.05F) {
      for (float z = 0.05F; z < 2.2F; z += 0.05F) cloud.lines.front().points.emplace_back(x, y, z);
    }
  }
  for (CloudLine& line : cloud.lines) line.origin = {0.0F, 0.0F, 0.9F};
  return cloud;
}

SurfaceMesh mesh_of(const Cloud& cloud) {
  const CloudStore clouds = test::stored({cloud});
  const SurveyGraph graph = test::graph_along_x(1, 1.0);
  return void_mesh(RegisteredCloud(clouds, graph));
}

TEST(VoidMesh, IsOpenWhereNothingWasSeen) {
  const MeshCheck check = check_mesh(mesh_of(tunnel(false)));
  EXPECT_EQ(check.parts, 1U);
  EXPECT_EQ(check.crossed_edges, 0U);
  EXPECT_EQ(check.border_loops, 2U);            // the ends
  EXPECT_GT(check.border_m, 0.9 * 2.0 * 12.4);  // across corners between points
  EXPECT_LT(check.border_m, 3.0 * 2.0 * 12.4);  // it goes to and fro between the last vertices
  EXPECT_NEAR(check.area_m2, 8.0 * 12.4, 3.0);
}

TEST(VoidMesh, IsWatertightWhereAllWasSeen) {
  const MeshCheck check = check_mesh(mesh_of(tunnel(true)));
  EXPECT_EQ(check.parts, 1U);
  EXPECT_EQ(check.crossed_edges, 0U);
  EXPECT_EQ(check.border_loops, 0U);
  EXPECT_NEAR(check.area_m2, 8.0 * 12.4 + 2.0 * 8.8, 3.0);
}

/// By Embree, the library of the simulator's lasers: a ray from inside of a closed surface meets it
/// once, at the distance of the wall, from the side of the void.
TEST(VoidMesh, HoldsTheRaysOfAnotherLibrary) {
  const SurfaceMesh mesh = mesh_of(tunnel(true));
  double volume_m3 = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume_m3 -= mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6.0;
  EXPECT_NEAR(volume_m3, 8.0 * 4.0 * 2.2, 1.5);  // sides are inwards
  TriangleMesh triangles;
  triangles.parts.push_back({});
  for (const Eigen::Vector3d& p : mesh.vertices) triangles.vertices.push_back(p.cast<float>());
  triangles.triangles = mesh.triangles;
  triangles.triangle_parts.assign(mesh.triangles.size(), 0);
  const RayScene scene(triangles);
  for (int i = 0; i < 500; ++i) {
    const double z = -1.0 + 2.0 * (i + 0.5) / 500.0;
    const double turn = 2.399963 * i;
    const Eigen::Vector3d direction(std::sqrt(1.0 - z * z) * std::cos(turn),
                                    std::sqrt(1.0 - z * z) * std::sin(turn), z);
    const Eigen::Vector3d from(0.3, -0.2, 1.0);
    const double to_ends = (direction.x() > 0.0 ? 3.7 : 4.3) / std::abs(direction.x());
    const double to_sides = (direction.y() > 0.0 ? 2.2 : 1.8) / std::abs(direction.y());
    const double to_roof = (direction.z() > 0.0 ? 1.2 : 1.0) / std::abs(direction.z());
    const auto hit = scene.cast({from.cast<float>(), direction.cast<float>()}, 20.0F);
    ASSERT_TRUE(hit) << i;
    EXPECT_NEAR(hit->distance_m, std::min({to_ends, to_sides, to_roof}), 0.25) << i;  // cut corners
  }
}

TEST(VoidMesh, CheckFindsWhatIsWrong) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_EQ(check_mesh(mesh).crossed_edges, 0U);
  EXPECT_EQ(check_mesh(mesh).border_loops, 1U);
  EXPECT_NEAR(check_mesh(mesh).border_m, 4.0, 1e-9);
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}};  // the other side
  EXPECT_EQ(check_mesh(mesh).crossed_edges, 1U);
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 4, 2}};  // three at an edge
  EXPECT_EQ(check_mesh(mesh).crossed_edges, 1U);
}

TEST(VoidMesh, IsReadByItsFiles) {
  const test::ScratchFolder folder;
  SurfaceMesh mesh;
  mesh.vertices = {
      {500000.125, 5600000.25, -12.5}, {500001.0, 5600000.0, 0.0}, {500000.0, 1.0, 2.0}};
  mesh.triangles = {{0, 1, 2}};
  write_mesh_ply(mesh, "a mesh", folder / "a.ply");
  write_mesh_obj(mesh, "a mesh", folder / "a.obj");
  EXPECT_THAT(test::contents(folder / "a.obj"),
              testing::AllOf(testing::HasSubstr("\nv 500000.125 5600000.250 -12.500\n"),
                             testing::EndsWith("f 1 2 3\n")));
  const std::string ply = test::contents(folder / "a.ply");
  EXPECT_THAT(ply, testing::StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 3 * 24 + 13);
}

}  // namespace
}  // namespace adit
