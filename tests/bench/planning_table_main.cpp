// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// planning_table [SCENES]: times of the steps of planning in random bent corridors with posts, as a
// table in Markdown. Each corridor has a free lane 2 m wide with a radius of curvature of at least
// 3 m.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include "procs/planning/lattice/cell_heuristic.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/planning.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

constexpr double kSolvedM = 5.0;  // least progress along the corridor in a solved scene

/// CPU time of this process, which does not depend on other processes.
double ms_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

struct Row {
  const char* name;
  std::vector<double> values;

  void print() {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    std::printf("| %s | %.1f | %.1f | %.1f |\n", name, at(0.5), at(0.95), at(1.0));
  }
};

void run(int scenes) {
  const PlanningParams params;
  const CSpaceKernels kernels(params.vehicle, params.c_space, 0.1);
  const MotionPrimitives primitives(params.vehicle, params.primitives, kernels.headings(), 0.1);
  Planning planning(params);
  Row rows[] = {{"C-space [ms]", {}},          {"heuristic [ms]", {}}, {"A* [ms]", {}},
                {"heuristic and A* [ms]", {}}, {"expansions", {}},     {"complete plan [ms]", {}}};
  int found = 0;
  int solved = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const TerrainMap terrain = terrain_of(random_corridor(static_cast<std::uint32_t>(seed)));
    const GroundLayers layers = ground_layers(terrain, {}, params.vehicle, params.c_space.ground);
    CSpace space(params.c_space.headings, 0, 0);
    rows[0].values.push_back(ms_of([&] { space = kernels.convolve(layers); }));
    const Lattice lattice{space, primitives};
    const GoalField goals(PlanGoal{}, {}, {}, terrain, params.goals);
    std::vector<std::int32_t> heuristic;
    rows[1].values.push_back(ms_of([&] { heuristic = cell_heuristic(lattice, goals, 0.1); }));
    LatticePath path;
    rows[2].values.push_back(ms_of([&] {
      path =
          search_lattice(lattice, kernels.headings(), nearest_pose(terrain, kernels.headings(), {}),
                         goals, heuristic, params.search);
    }));
    rows[3].values.push_back(rows[1].values.back() + rows[2].values.back());
    rows[4].values.push_back(path.expansions);
    PlannedPath plan;
    rows[5].values.push_back(ms_of([&] { plan = planning.plan(terrain, PlanGoal{}, {}); }));
    if (plan.outcome == PlanOutcome::kFound) ++found;
    if (plan.outcome == PlanOutcome::kFound && plan.reached_m >= kSolvedM) ++solved;
    if (plan.outcome != PlanOutcome::kFound || plan.reached_m < kSolvedM) {
      std::fprintf(stderr, "seed %d: %.1f m. %s\n", seed, plan.reached_m, plan.reason.c_str());
    }
  }
  std::printf("%d scenes, %d with a path, %d of them reach %.0f m\n\n", scenes, found, solved,
              kSolvedM);
  std::printf("| | median | 95 %% | worst |\n|---|---|---|---|\n");
  for (Row& row : rows) row.print();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) { adit::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 500); }
