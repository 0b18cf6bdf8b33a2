// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A subset of the corridors of corridor_scenes_table in tests/eval.
#include <gtest/gtest.h>

#include "tests/support/scores/corridor_run.hpp"
#include "tests/support/scores/path_feasibility.hpp"

namespace adit {
namespace {

constexpr int kScenes = 20;  // one per kind
constexpr double kDistanceM = 8.0;
constexpr double kInflationM = 0.2;  // cell size and regions of the terrain

class CorridorScenes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(OfBothEstimators, CorridorScenes, testing::Values("kth", "paper"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(CorridorScenes, PathsAreFreeOfCollisionsAndFoundIfFeasible) {
  Planning planning{PlanningParams{}};
  for (int seed = 0; seed < kScenes; ++seed) {
    const Corridor corridor = random_corridor_with_robot(seed);
    const CorridorRun run =
        run_corridor(corridor, GetParam(), static_cast<std::uint64_t>(seed), planning);
    EXPECT_FALSE(run.fault) << seed << ' ' << corridor.kind << ' ' << run.fault->what;
    if (run.found()) continue;
    EXPECT_LT(feasible_distance_m(corridor, inflated_vehicle(Vehicle{}, kInflationM), kDistanceM),
              kDistanceM)
        << seed << ' ' << corridor.kind << ' ' << run.path.reason;
  }
}

}  // namespace
}  // namespace adit
