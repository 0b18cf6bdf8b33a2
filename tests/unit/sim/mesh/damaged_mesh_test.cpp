// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Randomly damaged mesh files. They are not a target of the fuzzing program, since each is read in
// its own process, which takes milliseconds.
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/mesh/mesh_file.hpp"
#include "tests/fuzz/mutator.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr int kCases = 300;

constexpr std::string_view kObj = R"(o Floor
v -8 -2 0
v 8 -2 0
v 8 2 0
v -8 2 0
vn 0 0 1
vt 0 0
o Walls
v -8 -2 2
v 8 -2 2
v 8 2 2
v -8 2 2
f 1/1/1 2/1/1 3/1/1 4/1/1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f -5 -8 -4 -1
)";

constexpr std::string_view kPly = R"(ply
format ascii 1.0
comment a floor and a roof
element vertex 8
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
-8 -2 0
8 -2 0
8 2 0
-8 2 0
-8 -2 2
8 -2 2
8 2 2
-8 2 2
4 0 1 2 3
4 4 5 6 7
)";

constexpr std::string_view kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">-9 -9 0 9 -9 0 9 9 0 -9 9 0</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><translate>1 0 0</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

struct Format {
  std::string ending;
  std::string_view sample;
};

class DamagedMesh : public testing::TestWithParam<Format> {};

TEST_P(DamagedMesh, IsReadOrRejectedInOneLine) {
  const test::ScratchFolder scratch;
  const auto path = scratch / ("a." + GetParam().ending);
  const fuzz::Bytes sample(GetParam().sample.begin(), GetParam().sample.end());
  fuzz::Mutator mutator(7);
  int read = 0;
  for (int i = 0; i < kCases; ++i) {
    const fuzz::Bytes bytes = mutator.mutate({sample}, sample);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    try {
      load_mesh_file(path);
      ++read;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n"))) << "case " << i;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, kCases);
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedMesh,
                         testing::Values(Format{"obj", kObj}, Format{"ply", kPly},
                                         Format{"dae", kDae}),
                         [](const auto& format) { return format.param.ending; });

}  // namespace
}  // namespace adit
