// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Times of the steps of planning on a terrain map of 20 × 20 m: ground layers, C-space of 32
// headings at two cell sizes, heuristic, search, and the complete plan.
#include <benchmark/benchmark.h>

#include "procs/planning/lattice/cell_heuristic.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr std::uint32_t kSeed = 7;

TerrainMap scene(double cell_m = 0.1) { return terrain_of(random_corridor(kSeed), 20.0, cell_m); }

void layers(benchmark::State& state) {
  const TerrainMap terrain = scene();
  for (auto _ : state) {
    benchmark::DoNotOptimize(ground_layers(terrain, {}, Vehicle{}, GroundLimits{}));
  }
}
BENCHMARK(layers)->Unit(benchmark::kMillisecond);

void c_space(benchmark::State& state) {
  const double cell_m = static_cast<double>(state.range(0)) / 1000.0;
  const TerrainMap terrain = scene(cell_m);
  const GroundLayers ground = ground_layers(terrain, {}, Vehicle{}, GroundLimits{});
  const CSpaceKernels kernels(Vehicle{}, CSpaceParams{}, cell_m);
  for (auto _ : state) benchmark::DoNotOptimize(kernels.convolve(ground));
}
BENCHMARK(c_space)->Arg(100)->Arg(50)->ArgName("cell_mm")->Unit(benchmark::kMillisecond);

/// Inputs of a search.
struct SearchProblem {
  TerrainMap terrain = scene();
  PlanningParams params;
  CSpaceKernels kernels{params.vehicle, params.c_space, terrain.cell_m};
  MotionPrimitives primitives{params.vehicle, params.primitives, kernels.headings(),
                              terrain.cell_m};
  CSpace space =
      kernels.convolve(ground_layers(terrain, {}, params.vehicle, params.c_space.ground));
  Lattice lattice{space, primitives};
  GoalField goals{PlanGoal{}, {}, {}, terrain, params.goals};
};

void heuristic(benchmark::State& state) {
  const SearchProblem problem;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        cell_heuristic(problem.lattice, problem.goals, problem.terrain.cell_m));
  }
}
BENCHMARK(heuristic)->Unit(benchmark::kMillisecond);

void search(benchmark::State& state) {
  const SearchProblem problem;
  const auto heuristic_costs =
      cell_heuristic(problem.lattice, problem.goals, problem.terrain.cell_m);
  const LatticePose start = nearest_pose(problem.terrain, problem.kernels.headings(), {});
  for (auto _ : state) {
    const LatticePath path = search_lattice(problem.lattice, problem.kernels.headings(), start,
                                            problem.goals, heuristic_costs, problem.params.search);
    state.counters["expansions"] = path.expansions;
  }
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

void full_plan(benchmark::State& state) {
  const TerrainMap terrain = scene();
  Planning planning(PlanningParams{});
  for (auto _ : state) benchmark::DoNotOptimize(planning.plan(terrain, PlanGoal{}, {}));
}
BENCHMARK(full_plan)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
