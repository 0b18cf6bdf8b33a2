// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/lattice_search.hpp"

#include <gtest/gtest.h>

#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/cell_heuristic.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

/// A corridor with the maps of a search.
struct Scene {
  explicit Scene(std::uint32_t seed, const PlanGoal& to = {}, double side_m = 12.0)
      : terrain(terrain_of(random_corridor(seed), side_m)), goal(to) {}

  TerrainMap terrain;
  PlanGoal goal;
  Vehicle vehicle;
  CSpaceParams c_space;
  CSpaceKernels kernels{vehicle, c_space, terrain.cell_m};
  MotionPrimitives primitives{vehicle, {}, kernels.headings(), terrain.cell_m};
  CSpace space = kernels.convolve(ground_layers(terrain, {}, vehicle, c_space.ground));
  Lattice lattice{space, primitives};
  GoalField goals{goal, goal.T_odom_goal, {}, terrain, {}};
  LatticePose start = nearest_pose(terrain, kernels.headings(), {});

  [[nodiscard]] LatticePath search(const std::vector<std::int32_t>& heuristic) const {
    return search_lattice(lattice, kernels.headings(), start, goals, heuristic,
                          {.expansions_max = 10000000});
  }
};

PlanGoal goal_behind(double x, double y) {
  PlanGoal goal;
  goal.kind = PlanGoal::Kind::kToPose;
  goal.T_odom_goal = {x, y, 0.5};
  return goal;
}

TEST(LatticeSearch, FindsTheCostOfDijkstra) {
  int found = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Scene scene(seed, seed % 3 == 0 ? goal_behind(-1.5, 0.4) : PlanGoal{});
    const LatticePath a_star = scene.search(cell_heuristic(scene.lattice, scene.goals, 0.1));
    const LatticePath dijkstra = scene.search(std::vector<std::int32_t>(scene.space.cells(), 0));
    ASSERT_EQ(a_star.found, dijkstra.found) << seed;
    EXPECT_EQ(a_star.cost, dijkstra.cost) << seed;
    EXPECT_LT(a_star.expansions, dijkstra.expansions) << seed;
    if (a_star.found) ++found;
  }
  EXPECT_GE(found, 8);
}

TEST(LatticeSearch, HasAConsistentHeuristic) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const Scene scene(seed);
    const auto heuristic = cell_heuristic(scene.lattice, scene.goals, 0.1);
    for (int heading = 0; heading < 32; ++heading) {
      for (int row = 0; row < scene.space.rows(); row += 3) {
        for (int column = 0; column < scene.space.columns(); column += 3) {
          const LatticePose pose{column, row, heading};
          if (!scene.lattice.is_valid(pose)) continue;
          for (const auto& step : scene.primitives.from(heading)) {
            const std::int32_t cost = scene.lattice.cost(pose, step);
            if (cost == Lattice::kBlocked) continue;
            const LatticePose next = Lattice::successor(pose, step);
            const std::int32_t successor = heuristic[scene.space.index(next.column, next.row)];
            if (successor == kUnreachable) continue;
            ASSERT_LE(heuristic[scene.space.index(column, row)], cost + successor);
          }
        }
      }
    }
  }
}

TEST(LatticeSearch, SumsUpTheCostsOfItsSteps) {
  const Scene scene(1);
  const LatticePath path = scene.search(cell_heuristic(scene.lattice, scene.goals, 0.1));
  ASSERT_TRUE(path.found);
  LatticePose pose = scene.start;
  std::int32_t cost = 0;
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    cost += scene.lattice.cost(pose, *path.steps[i]);
    pose = Lattice::successor(pose, *path.steps[i]);
    EXPECT_EQ(path.costs[i], cost) << "without changes of direction";
  }
  EXPECT_EQ(path.cost, cost + scene.goals.ending_cost(scene.space.index(pose.column, pose.row)));
}

TEST(LatticeSearch, StopsAtTheMaximumNumberOfExpansions) {
  const Scene scene(1);
  const LatticePath path =
      search_lattice(scene.lattice, scene.kernels.headings(), scene.start, scene.goals,
                     std::vector<std::int32_t>(scene.space.cells(), 0), {.expansions_max = 5});
  EXPECT_TRUE(path.abandoned);
  EXPECT_FALSE(path.found);
  EXPECT_EQ(path.expansions, 5);
}

}  // namespace
}  // namespace adit
