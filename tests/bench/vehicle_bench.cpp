// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// CPU time to simulate one second of a vehicle that drives over rough ground of a million
// triangles.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "sim/mesh/mesh_builder.hpp"
#include "sim/vehicle/vehicle_model.hpp"

namespace adit {
namespace {

constexpr float kSideM = 70.0F;

/// A wavy surface around a height, with amplitudes of some centimetres, over the complete hall.
void add_surface(MeshBuilder& builder, float height_m, int cells) {
  const float cell_m = kSideM / static_cast<float>(cells);
  std::vector<std::uint32_t> before;
  for (int i = 0; i <= cells; ++i) {
    std::vector<std::uint32_t> row;
    for (int j = 0; j <= cells; ++j) {
      const float x = cell_m * static_cast<float>(i) - 0.5F * kSideM;
      const float y = cell_m * static_cast<float>(j) - 0.5F * kSideM;
      const float wave = 0.04F * std::sin(2.0F * x) * std::cos(3.0F * y);
      row.push_back(builder.vertex({x, y, height_m + wave + 0.01F * std::sin(17.0F * x)}));
    }
    for (std::size_t j = 1; j < before.size(); ++j) {
      builder.quad(before[j - 1], row[j - 1], row[j], before[j]);
    }
    before = row;
  }
}

World rough_hall() {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "floor");
  add_surface(builder, 0.0F, 700);  // 980 000 triangles
  builder.begin_part(PartKind::kRoof, Material::kRock, "roof");
  add_surface(builder, 2.0F, 100);
  World world;
  world.mesh = builder.take();
  world.T_world_start = {0.0, -10.0, 0.0};
  world.truth.floor_height = [](const Eigen::Vector2d&) { return 0.0; };
  return world;
}

/// One simulated second per iteration.
void drive_in_circles(benchmark::State& state) {
  const Site site(rough_hall());
  VehicleModel vehicle(site, {}, {}, 1, 0);
  for (auto _ : state) {
    for (int i = 0; i < 100; ++i) {
      vehicle.command(DriveCommand{vehicle.motion().utime, 0.3, 0.1});
      vehicle.advance(0.01);
    }
    if (vehicle.failure()) state.SkipWithError(vehicle.failure()->c_str());
  }
}
BENCHMARK(drive_in_circles)->Unit(benchmark::kMillisecond)->Iterations(300);

}  // namespace
}  // namespace adit
