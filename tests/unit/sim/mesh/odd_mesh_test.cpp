// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Invalid meshes.
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/ray_scene.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class OddMesh : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(scratch_ / name, std::ios::binary) << text;
    return scratch_ / name;
  }

  std::string error_of(const std::string& name, const std::string& text) {
    try {
      load_mesh_file(write(name, text));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder scratch_;
};

TEST_F(OddMesh, AnnouncingMillionsOfElementsIsRejected) {
  const auto one_line = AllOf(HasSubstr("announces"), Not(HasSubstr("\n")));
  EXPECT_THAT(error_of("a.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3000000000\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n0 0 0\n3 0 1 2\n"),
              one_line);
  EXPECT_THAT(error_of("b.ply", "ply\nformat ascii 1.0\nelement vertex -3\nend_header\n"),
              one_line);
  EXPECT_THAT(error_of("a.dae",
                       "<?xml version=\"1.0\"?><COLLADA><library_geometries><geometry><mesh>"
                       "<source><float_array count=\"3000000000\">0 0 0</float_array></source>"
                       "</mesh></geometry></library_geometries></COLLADA>"),
              one_line);
}

TEST_F(OddMesh, WithAnUnterminatedHeaderIsRejected) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n";
  EXPECT_THAT(error_of("a.ply", header), HasSubstr("no end"));
  EXPECT_THAT(error_of("a.ply", header + "end_headi\xf4\x7f\n-8 -"),
              HasSubstr("not valid in a PLY file"));
}

TEST_F(OddMesh, OfInvalidXmlIsRejected) {
  EXPECT_NE(error_of("a.dae", "<?xml version=\"1.0\"?><COLLADA><mesh></COLLADA>"), "");
  EXPECT_NE(error_of("b.dae", "<?xml version=\"1.0\"?><html><body/></html>"), "");
}

TEST_F(OddMesh, WithIndicesOutOfRangeIsRejectedOrDropsThem) {
  const std::string corners = "v 0 0 0\nv 10 0 0\nv 10 10 0\n";
  for (const char* face : {"f 1 2 9\n", "f 0 1 2\n", "f -9 1 2\n", "f 1 2 99999999999\n"}) {
    try {
      EXPECT_LE(load_mesh_file(write("a.obj", corners + "f 1 2 3\n" + face)).triangles.size(), 2U);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST_F(OddMesh, OfAHundredThousandTrianglesInOnePlaceIsRead) {
  std::string text = "v 0 0 0\nv 10 0 0\nv 10 10 0\n";
  for (int i = 0; i < 100'000; ++i) text += "f 1 2 3\n";
  const TriangleMesh mesh = load_mesh_file(write("a.obj", text));
  EXPECT_EQ(mesh.triangles.size(), 100'000U);
  const RayScene scene(mesh);
  EXPECT_TRUE(scene.cast({{5.0F, 2.0F, 3.0F}, {0.0F, 0.0F, -1.0F}}, 10.0F));
}

TEST(MeshBuilder, NumbersThousandsOfDuplicateNames) {
  MeshBuilder builder;
  for (int i = 0; i < 50'000; ++i) {
    builder.begin_part(PartKind::kPost, Material::kTimber, i == 3 ? "post_5" : "post");
  }
  EXPECT_EQ(builder.mesh().parts[0].name, "post");
  EXPECT_EQ(builder.mesh().parts[1].name, "post_2");
  EXPECT_EQ(builder.mesh().parts[5].name, "post_6");  // post_5 is taken
  EXPECT_EQ(builder.mesh().parts.back().name, "post_50000");
}

TEST(MeshBuilder, RejectsMoreThanTheLimits) {
  MeshBuilder builder;
  EXPECT_THROW(builder.reserve(0, MeshBuilder::kTrianglesMax + 1), std::invalid_argument);
  EXPECT_THROW(builder.reserve(MeshBuilder::kTrianglesMax + 1, 0), std::invalid_argument);
}

TEST(RayScene, PassesWaterKilometresAway) {
  // At 10 km neighbouring numbers of single precision are 1 mm apart.
  MeshBuilder builder;
  const auto add_square = [&](PartKind kind, Material material, float z) {
    builder.begin_part(kind, material, "square");
    builder.quad(builder.vertex({-1.0F, -1.0F, z}), builder.vertex({1.0F, -1.0F, z}),
                 builder.vertex({1.0F, 1.0F, z}), builder.vertex({-1.0F, 1.0F, z}));
  };
  add_square(PartKind::kWater, Material::kWater, 10'000.0F);
  add_square(PartKind::kRoof, Material::kRock, 10'002.0F);
  const RayScene scene(builder.mesh());
  const Ray up{{0.2F, 0.1F, 0.0F}, Eigen::Vector3f::UnitZ()};
  const auto hit = scene.cast(up, 20'000.0F, RayScene::Layer::kSolid);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 10'002.0F, 0.002);  // two steps of single precision
}

}  // namespace
}  // namespace adit
