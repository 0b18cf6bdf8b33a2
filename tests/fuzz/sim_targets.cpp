// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What people give to the simulator: meshes of any make, and descriptions of mines.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit::fuzz {
namespace {

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

constexpr std::string_view kWorld = R"(world:
  name: small
  seed: 3
  grid_m: 0.9
  T_world_start: {x_m: 2, y_m: 0, theta_rad: 0}
  plan:
    drifts:
      - {name: main, points_m: [0, 0, 12, 0], width_m: 3, entrance: true}
    panels:
      - {name: p, entries: 1, crosscuts: 0, length_m: 9}
    rooms:
      - {name: hall, points_m: [8, -4, 12, -4, 12, 4, 8, 4]}
    pillars:
      - {name: rock, points_m: [9, 2, 10, 2, 10, 3]}
  heights: {profile_m: [0, 0, 9, 1], opening_m: 2, floor_relief: {octaves: 1}}
  wall_relief: {height_m: 0.1, length_m: 1.5, octaves: 1}
  props:
    rails: [{drift: main, from_m: 1, to_m: 4}]
    posts: [{drift: main, from_m: 4, to_m: 6, every_m: 1}]
    cribs: [{drift: main, at_m: 5}]
    rubble: [{drift: main, at_m: 7, radius_m: 0.3}]
    beams: [{drift: main, at_m: 8, cables: 1}]
    cars: [{drift: main, at_m: 9}]
    low_roofs: [{name: low, drift: main, from_m: 6, to_m: 7}]
    pits: [{name: hole, drift: main, at_m: 10}]
    water: [{name: pool, drift: main, from_m: 3, to_m: 5}]
    mud: [{name: mud, drift: main, at_m: 11}]
    gas: [{name: damp, drift: main, at_m: 11}]
)";

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// A file of this ending is made into a mine, as `adit sim FILE` does.
Target world_target(std::string_view ending, std::string_view sample) {
  const auto folder = std::make_shared<test::ScratchFolder>();
  const auto take = [folder, ending](std::span<const std::uint8_t> bytes) -> std::string_view {
    const std::filesystem::path path = *folder / ("mine." + std::string(ending));
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    try {
      const Site site(build_world(find_world(path.string())));
    } catch (const std::invalid_argument&) {
      return "cannot be built";
    } catch (const std::runtime_error&) {
      return "cannot be read";
    }
    return {};
  };
  return {"world of ." + std::string(ending), {bytes_of(sample)}, take};
}

}  // namespace

std::vector<Target> world_targets() {
  return {world_target("obj", kObj), world_target("ply", kPly), world_target("dae", kDae),
          world_target("yaml", kWorld)};
}

}  // namespace adit::fuzz
