// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Time to make a terrain map of 20 × 20 m with cells of 0.1 m from a 3D scan of 240 × 361 beams.
// Times are CPU times, which hardly depend on other processes.
#include <vector>

#include <benchmark/benchmark.h>

#include "procs/terrain/terrain.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

Cloud scan_of(const char* world, const char* tunnel, double s_m) {
  const WorldDescription description = find_world(world);
  const Site site(build_world(description));
  const auto tunnels = tunnel_lines(description.plan);
  const auto [p_world, heading_rad] = find_tunnel(tunnels, tunnel, "bench").at(s_m);
  return tilt_sweep(site, level_on_floor(site.world(), {p_world.x(), p_world.y(), heading_rad}));
}

void make_terrain(benchmark::State& state, const Cloud& cloud, const char* estimator) {
  TerrainParams params;
  params.estimator.kind = estimator;
  const Terrain terrain(params);
  for (auto _ : state) benchmark::DoNotOptimize(terrain.make(cloud));
  state.counters["points"] = static_cast<double>(cloud.points());
}

void free_corridor(benchmark::State& state, const char* estimator) {
  static const Cloud cloud = scan_of("mathies", "main", 50.0);
  make_terrain(state, cloud, estimator);
}

void broken_beam(benchmark::State& state, const char* estimator) {
  static const Cloud cloud = scan_of("mathies", "main", 300.0);
  make_terrain(state, cloud, estimator);
}

/// With the memory of earlier 3D scans, as in a mission.
void with_memory(benchmark::State& state) {
  static std::vector<Cloud> clouds{
      scan_of("mathies", "main", 44.0), scan_of("mathies", "main", 46.0),
      scan_of("mathies", "main", 48.0), scan_of("mathies", "main", 50.0)};
  const TerrainParams params;
  const Terrain terrain(params);
  TerrainMemory memory(params);
  std::int64_t utime = 0;
  for (Cloud& cloud : clouds) {
    for (int scan_index = 0; scan_index < 2; ++scan_index) {
      cloud.utime = utime += 20'000'000;
      benchmark::DoNotOptimize(terrain.make(cloud, memory));
    }
  }
  int used = 0;
  for (auto _ : state) {
    state.PauseTiming();
    TerrainMemory memory_copy = memory;
    state.ResumeTiming();
    benchmark::DoNotOptimize(terrain.make(clouds.back(), memory_copy));
    used = memory_copy.recall_result().used;
  }
  state.counters["remembered_scans"] = used;
}

BENCHMARK(with_memory)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(free_corridor, kth, "kth")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(free_corridor, paper, "paper")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broken_beam, kth, "kth")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(broken_beam, paper, "paper")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
