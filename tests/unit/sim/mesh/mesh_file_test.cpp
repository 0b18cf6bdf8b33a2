// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_file.hpp"

#include <array>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/mesh/ray_scene.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kSquare = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 2\n";

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(scratch_ / name, std::ios::binary) << text;
    return scratch_ / name;
  }

  static std::string error_of(const std::filesystem::path& file,
                              const MeshFileParams& params = {}) {
    try {
      load_mesh_file(file, params);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.filename().string()));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    return "";
  }

  test::ScratchFolder scratch_;
};

TEST_F(MeshFile, ReadsAnObjAndNamesItsParts) {
  const TriangleMesh mesh = load_mesh_file(
      write("a.obj", std::string(kSquare) + "o Floor_1\nf 1 2 3\no lump\nf 1 3 4\n"));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.part_of(0).kind, PartKind::kFloor);
  EXPECT_EQ(mesh.part_of(0).name, "Floor_1");
  EXPECT_EQ(mesh.part_of(1).kind, PartKind::kOther);
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][1]], Eigen::Vector3f(10.0F, 0.0F, 0.0F));
}

TEST_F(MeshFile, ReadsAPlyAndSplitsItsPolygons) {
  const TriangleMesh mesh = load_mesh_file(
      write("a.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n10 0 0\n10 10 0\n0 10 0\n4 0 1 2 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST_F(MeshFile, ReadsADaeWithTheAxesAndTransformsOfItsNodes) {
  const TriangleMesh mesh = load_mesh_file(write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g" name="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 10 0 0 0 10 5</float_array>
      <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n">
    <translate>100 0 0</translate><instance_geometry url="#g"/>
  </node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)"));
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][2]], Eigen::Vector3f(100.0F, 10.0F, 5.0F));
}

TEST_F(MeshFile, ScalesAndTurnsTheAxisUp) {
  const auto file = write("a.obj", "v 1 2 3\nv 11 2 3\nv 1 12 3\nf 1 2 3\n");
  const auto first = [&](double scale, char up) {
    const TriangleMesh mesh = load_mesh_file(file, {scale, up});
    return mesh.vertices[mesh.triangles[0][0]];
  };
  EXPECT_EQ(first(2.0, 'z'), Eigen::Vector3f(2.0F, 4.0F, 6.0F));
  EXPECT_EQ(first(1.0, 'y'), Eigen::Vector3f(1.0F, -3.0F, 2.0F));
  EXPECT_EQ(first(1.0, 'x'), Eigen::Vector3f(2.0F, 3.0F, 1.0F));
}

TEST_F(MeshFile, ReportsAMissingFile) {
  EXPECT_THAT(error_of(scratch_ / "none.obj"), StartsWith("there is no mesh file"));
  std::filesystem::create_directory(scratch_ / "folder.obj");
  EXPECT_THAT(error_of(scratch_ / "folder.obj"), StartsWith("there is no mesh file"));
}

TEST_F(MeshFile, ReportsAFileThatIsNotAMesh) {
  EXPECT_THAT(error_of(write("empty.obj", "")), HasSubstr("is empty"));
  EXPECT_NE(error_of(write("text.obj", "Dear reader,\nthis is a letter.\n")), "");
  EXPECT_THAT(error_of(write("text.ply", "Dear reader")), HasSubstr("is not a mesh"));
  EXPECT_THAT(error_of(write("text.dae", "<COLLADA")), HasSubstr("is not a mesh"));
  EXPECT_THAT(error_of(write("picture.jpg", "\xff\xd8\xff\xe0")), HasSubstr("is not a mesh"));
  EXPECT_NE(error_of(write("points.obj", kSquare)), "");
}

TEST_F(MeshFile, SurvivesRandomBytes) {
  std::mt19937_64 random(1);
  for (const char* name : {"a.obj", "a.ply", "a.dae", "a.stl", "a.glb"}) {
    std::string bytes(5000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random() & 0xffU);
    EXPECT_NE(error_of(write(name, bytes)), "") << name;
  }
}

TEST_F(MeshFile, DropsTrianglesWithoutArea) {
  const auto file = write("a.obj", std::string(kSquare) + "f 1 2 3\nf 1 1 2\nf 3 3 3\nf 1 3 4\n");
  const TriangleMesh mesh = load_mesh_file(file);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_THAT(error_of(write("b.obj", std::string(kSquare) + "f 1 1 2\n")),
              HasSubstr("no triangle with an area"));
}

TEST_F(MeshFile, DropsVerticesThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\n"
      "property float y\nproperty float z\nelement face 3\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (const float f :
       {0.F, 0.F, 0.F, 10.F, 0.F, 0.F, 10.F, 10.F, 0.F, nan, 0.F, 0.F, 1.F, infinity, 1.F}) {
    text.append(reinterpret_cast<const char*>(&f), sizeof f);
  }
  for (const std::array<int, 3>& face : {std::array{0, 1, 2}, {0, 1, 3}, {0, 4, 2}}) {
    text += '\3';
    text.append(reinterpret_cast<const char*>(face.data()), sizeof face);
  }
  const TriangleMesh mesh = load_mesh_file(write("a.ply", text));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  const RayScene scene(mesh);
  EXPECT_TRUE(scene.cast({{5.0F, 2.0F, 3.0F}, {0.0F, 0.0F, -1.0F}}, 10.0F));
}

TEST_F(MeshFile, RejectsAnImplausibleSize) {
  const std::string text = std::string(kSquare) + "f 1 2 3\n";
  const auto file = write("a.obj", text);
  EXPECT_THAT(error_of(file, {0.001, 'z'}), HasSubstr("scale"));
  EXPECT_THAT(error_of(file, {10000.0, 'z'}), HasSubstr("scale"));
  EXPECT_EQ(error_of(file, {0.5, 'z'}), "");
  EXPECT_THAT(error_of(write("far.obj", "v 5e6 0 0\nv 5e6 9 0\nv 5000090 0 0\nf 1 2 3\n")),
              HasSubstr("from its origin"));
}

}  // namespace
}  // namespace adit
