// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A sample of the corridors of tests/eval, corridor_scenes_table.
#include <gtest/gtest.h>

#include "tests/support/scores/corridor_run.hpp"
#include "tests/support/scores/path_feasibility.hpp"

namespace adit {
namespace {

constexpr int kScenes = 20;  // one of each kind
constexpr double kEnoughM = 8.0;
constexpr double kRoomM = 0.2;  // what cells and the regions of the terrain take away

class CorridorScenes : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(OfBothEstimators, CorridorScenes, testing::Values("kth", "paper"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(CorridorScenes, AreDrivenWithoutFaultAndSolvedWhereThereIsRoom) {
  Planning planning{PlanningParams{}};
  for (int seed = 0; seed < kScenes; ++seed) {
    const Corridor corridor = random_corridor_with_robot(seed);
    const CorridorRun run =
        run_corridor(corridor, GetParam(), static_cast<std::uint64_t>(seed), planning);
    EXPECT_FALSE(run.fault) << seed << ' ' << corridor.kind << ' ' << run.fault->what;
    if (run.found()) continue;
    EXPECT_LT(feasible_distance_m(corridor, inflated_vehicle(Vehicle{}, kRoomM), kEnoughM),
              kEnoughM)
        << seed << ' ' << corridor.kind << ' ' << run.path.reason;
  }
}

}  // namespace
}  // namespace adit
