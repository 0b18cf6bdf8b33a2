// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "tests/support/graphs/labelled_graph.hpp"

namespace adit::test {

enum class GraphWorld { kGrid, kRings, kMine };
enum class WrongLoops { kRandom, kGroups, kParallel };

/// A world, the noise of its odometry, and the wrong loop closures in it.
struct GraphScenario {
  GraphWorld world = GraphWorld::kGrid;
  int poses = 1000;     ///< one per metre driven
  int right = 1000;     ///< right loop closures, at most
  double drift = 0.01;  ///< standard deviation of each step [m] and, a tenth of it, [rad]
  WrongLoops wrong = WrongLoops::kRandom;
  double wrong_share = 0.2;  ///< of all loop closures, below 1
  std::uint32_t seed = 1;
};

/// A scenario drawn by its seed: each world, a drift of 0.002 to 0.2 (log-uniform), each kind of
/// wrong loop closures, 5 to 80 % of all.
GraphScenario random_scenario(std::uint32_t seed);

std::string text(GraphWorld world);
std::string text(WrongLoops wrong);

/// Simulates a drive:
/// - a random walk on the streets of a grid of 10 m blocks;
/// - laps of rings of different radii that touch each other;
/// - a mine: parallel entries 12 m apart, joined by crosscuts, driven in and out.
///
/// Right loop closures link poses less than 2.5 m apart that were reached more than 20 m apart,
/// with an error of 0.05 m and 0.01 rad. Wrong ones link random poses; or sections of up to 20 m as
/// if they were one; or whole tunnels of up to 100 m that look alike: parallel ones where the world
/// has them. Poses are those of the odometry; deterministic for the scenario.
LabelledGraph generated_graph(const GraphScenario& scenario);

/// Measures the odometry again, with an error of 0.05 m and 0.2 rad for each metre.
void lose_heading(LabelledGraph& labelled, std::uint32_t seed);

}  // namespace adit::test
