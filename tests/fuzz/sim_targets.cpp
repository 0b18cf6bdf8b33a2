// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for the input files of the simulator: world files.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "sim/world/world_file.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit::fuzz {
namespace {

constexpr std::string_view kWorld = R"(world:
  name: small
  seed: 3
  grid_m: 0.9
  T_world_start: {x_m: 2, y_m: 0, theta_rad: 0}
  plan:
    tunnels:
      - {name: main, points_m: [0, 0, 12, 0], width_m: 3, entrance: true}
    panels:
      - {name: p, entries: 1, crosscuts: 0, length_m: 9}
    rooms:
      - {name: hall, points_m: [8, -4, 12, -4, 12, 4, 8, 4]}
    pillars:
      - {name: rock, points_m: [9, 2, 10, 2, 10, 3]}
  heights: {profile_m: [0, 0, 9, 1], clearance_m: 2, floor_relief: {octaves: 1}}
  wall_relief: {height_m: 0.1, length_m: 1.5, octaves: 1}
  props:
    rails: [{tunnel: main, from_m: 1, to_m: 4}]
    posts: [{tunnel: main, from_m: 4, to_m: 6, every_m: 1}]
    cribs: [{tunnel: main, at_m: 5}]
    rubble: [{tunnel: main, at_m: 7, radius_m: 0.3}]
    beams: [{tunnel: main, at_m: 8, cables: 1}]
    cars: [{tunnel: main, at_m: 9}]
    low_roofs: [{name: low, tunnel: main, from_m: 6, to_m: 7}]
    pits: [{name: hole, tunnel: main, at_m: 10}]
    water: [{name: pool, tunnel: main, from_m: 3, to_m: 5}]
    mud: [{name: mud, tunnel: main, at_m: 11}]
    gas: [{name: damp, tunnel: main, at_m: 11}]
)";

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// Reads a world file and writes it again. The world is not built: a mine just below the size limit
/// takes longer than the time limit of a case.
std::string_view take_world(const std::filesystem::path& path,
                            std::span<const std::uint8_t> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  try {
    to_world_file(find_world(path.string()));
  } catch (const std::runtime_error&) {
    return "cannot be read";
  }
  return {};
}

Target world_file_target() {
  const auto folder = std::make_shared<test::ScratchFolder>();
  return {"world file", {bytes_of(kWorld)}, [folder](std::span<const std::uint8_t> bytes) {
            return take_world(*folder / "mine.yaml", bytes);
          }};
}

}  // namespace

std::vector<Target> world_targets() { return {world_file_target()}; }

}  // namespace adit::fuzz
