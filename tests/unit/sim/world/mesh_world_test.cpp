// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Worlds of mesh files.
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class MeshWorld : public testing::Test {
 protected:
  /// Writes the mesh to a file and describes a world of it.
  WorldDescription description_of(const TriangleMesh& mesh) {
    std::ofstream file(scratch_ / "mine.obj");
    for (const Eigen::Vector3f& v : mesh.vertices) {
      file << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
    WorldDescription description;
    description.mesh.file = scratch_ / "mine.obj";
    return description;
  }

  static std::string error_of(const WorldDescription& description) {
    try {
      build_world(description);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder scratch_;
};

TEST_F(MeshWorld, ABoxHasItsFloorAndItsOutline) {
  const World world = build_world(description_of(box_tunnel().mesh));
  EXPECT_NEAR(world.truth.floor_height({3.0, 1.0}).value(), 0.0, 1e-6);  // single precision
  EXPECT_FALSE(world.truth.floor_height({3.0, 3.0}));
  EXPECT_TRUE(world.truth.tunnels.edges.empty());
  ASSERT_EQ(world.truth.plan.size(), 1U);
  EXPECT_NEAR(world.truth.plan[0].signed_area_m2(), 160.0, 1e-3);
  EXPECT_EQ(Site(world).scene().mesh().triangles.size(), 12U);
}

TEST_F(MeshWorld, GroundBelowTheRockIsNotFloor) {
  const World box = box_tunnel({}, [](MeshBuilder& builder) {
    builder.box(level_box({0.0, 0.0, 1.0}, {42.0, 6.0, 2.8}));  // 0.4 m of rock all around
  });
  const World world = build_world(description_of(box.mesh));
  EXPECT_NEAR(world.truth.floor_height({3.0, 1.0}).value(), 0.0, 1e-6);
  ASSERT_EQ(world.truth.plan.size(), 1U);
  EXPECT_NEAR(world.truth.plan[0].signed_area_m2(), 160.0, 1e-3);
}

TEST_F(MeshWorld, ObjectsArePillarsOfThePlan) {
  const World box = box_tunnel({}, [](MeshBuilder& builder) {
    builder.box(level_box({5.0, 0.0, 1.0}, {1.0, 1.0, 2.2}));
  });
  const World world = build_world(description_of(box.mesh));
  ASSERT_EQ(world.truth.plan.size(), 2U);
  EXPECT_FALSE(world.truth.plan[0].is_pillar());
  EXPECT_NEAR(world.truth.plan[1].signed_area_m2(), -1.0, 1e-5);
}

TEST_F(MeshWorld, AFlatFloorAndRoofAreAddedOnRequest) {
  TriangleMesh walls = box_tunnel().mesh;
  walls.triangles.erase(walls.triangles.begin(), walls.triangles.begin() + 4);
  WorldDescription description = description_of(walls);
  EXPECT_THAT(error_of(description), HasSubstr("no floor at the start"));
  description.mesh.flat_floor = true;
  description.mesh.floor_m = 0.2;
  description.mesh.flat_roof = true;
  description.mesh.roof_m = 1.9;
  const World world = build_world(description);
  EXPECT_NEAR(world.truth.floor_height({3.0, 1.0}).value(), 0.2, 1e-6);
  EXPECT_EQ(world.mesh.parts.back().kind, PartKind::kRoof);
}

TEST_F(MeshWorld, TheTopOfAnAddedRoofIsNotFloor) {
  TriangleMesh walls = box_tunnel().mesh;
  walls.triangles.erase(walls.triangles.begin(), walls.triangles.begin() + 4);
  WorldDescription description = description_of(walls);
  description.mesh.flat_roof = true;
  EXPECT_THAT(error_of(description), HasSubstr("no floor at the start, x 0, y 0"));
}

/// The walls of two tunnels of 4 m width that leave the corner of a square, (0, 0), along x and y.
TriangleMesh corner_walls() {
  MeshBuilder builder;
  builder.begin_part(PartKind::kOther, Material::kRock, "walls");
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    builder.box(
        level_box({(x0 + x1) / 2.0, (y0 + y1) / 2.0, 1.0}, {x1 - x0 + 0.1, y1 - y0 + 0.1, 2.0}));
  };
  wall(-2.0, -2.0, 30.0, -2.0);
  wall(-2.0, -2.0, -2.0, 30.0);
  wall(2.0, 2.0, 30.0, 2.0);
  wall(2.0, 2.0, 2.0, 30.0);
  wall(30.0, -2.0, 30.0, 2.0);
  wall(-2.0, 30.0, 2.0, 30.0);
  return builder.take();
}

TEST_F(MeshWorld, AStartBesideTheMineIsRejectedWhereFloorAndRoofWereAdded) {
  WorldDescription description = description_of(corner_walls());
  description.mesh.flat_floor = true;
  description.mesh.flat_roof = true;
  EXPECT_EQ(error_of(description), "");
  description.T_world_start = {20.0, 0.0, 0.0};
  EXPECT_EQ(error_of(description), "");
  description.T_world_start = {25.0, 25.0, 0.0};  // within the rectangle of the mesh, in rock
  EXPECT_THAT(error_of(description),
              HasSubstr("no walls around the floor at the start, x 25, y 25"));
  description.T_world_start = {60.0, 25.0, 0.0};
  EXPECT_THAT(error_of(description), HasSubstr("no floor at the start, x 60, y 25"));
}

TEST_F(MeshWorld, ARejectedStartSaysWhereFloorIs) {
  WorldDescription description = description_of(box_tunnel().mesh);
  description.T_world_start = {50.0, 0.0, 0.0};
  const std::string error = error_of(description);
  EXPECT_THAT(error, HasSubstr("the nearest one is at x "));
  double x = 0.0;
  double y = 0.0;
  ASSERT_EQ(
      std::sscanf(error.substr(error.find("one is at")).c_str(), "one is at x %lf, y %lf", &x, &y),
      2);
  description.T_world_start = {x, y, 0.0};
  EXPECT_EQ(error_of(description), "");
}

TEST_F(MeshWorld, AnOpenMeshIsAWorldWithoutOutline) {
  TriangleMesh mesh = box_tunnel().mesh;
  mesh.triangles.pop_back();
  EXPECT_TRUE(build_world(description_of(mesh)).truth.plan.empty());
}

TEST_F(MeshWorld, RejectsAStartOutsidePropsAndAPlan) {
  WorldDescription description = description_of(box_tunnel().mesh);
  description.T_world_start = {50.0, 0.0, 0.0};
  EXPECT_THAT(error_of(description), HasSubstr("no floor at the start"));
  description.T_world_start = {};
  description.props.posts = {{.tunnel = "main"}};
  EXPECT_THAT(error_of(description), HasSubstr("no tunnels"));
  description.props.posts.clear();
  description.plan.tunnels = {{"main", {0.0, 0.0, 30.0, 0.0}, 3.0, false}};
  EXPECT_THAT(error_of(description), HasSubstr("not both"));
}

}  // namespace
}  // namespace adit
