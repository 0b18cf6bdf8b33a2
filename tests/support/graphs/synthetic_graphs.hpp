// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

/// A walk of `nodes` poses round and round a square of `side` metres, one metre a step, with
/// constraints from each pose to the next and to the one a round before. Measurements are noisy by
/// `noise` metres and a tenth of it in radians, their information full and different for each;
/// the poses are true. Two calls with the same arguments give the same graph.
PoseGraph square_trajectory_graph(int nodes, int side, double noise, std::uint32_t seed = 1);

}  // namespace adit::test

namespace adit::test {

/// A constraint that is not between neighbours in the order of the nodes.
bool is_loop(const PoseConstraint& constraint);

/// `count` constraints between nodes drawn at random, claiming that these are within a metre of
/// each other. The poses of `graph` say where they are: a claim is wrong by three metres at least.
/// The information of each is that of a loop of the graph drawn at random.
std::vector<PoseConstraint> random_wrong_loops(const PoseGraph& graph, int count,
                                               std::uint32_t seed);

/// The same in groups of up to 20 that agree with each other: two stretches of the way are taken
/// for the same, as in parallel corridors, and each node of one is linked with its like in the
/// other.
std::vector<PoseConstraint> consistent_wrong_loops(const PoseGraph& graph, int count,
                                                   std::uint32_t seed);

}  // namespace adit::test
