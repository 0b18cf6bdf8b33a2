// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"

namespace adit::test {

/// A trajectory of `nodes` poses around a square of `side` metres, one metre per step, with
/// constraints to the next pose and to the pose one round earlier. Measurement noise is `noise`
/// metres and a tenth of it in radians; information matrices are full and differ. The poses are the
/// ground truth. Deterministic for the arguments.
PoseGraph square_trajectory_graph(int nodes, int side, double noise, std::uint32_t seed = 1);

/// Whether a constraint does not connect consecutive nodes.
bool is_loop(const PoseConstraint& constraint);

/// `count` false loop closures between random nodes, with relative positions below 1 m in x and y.
/// By the poses of `graph`, each is wrong by more than 3 m. Information matrices are drawn from the
/// loop closures of the graph.
std::vector<PoseConstraint> random_wrong_loops(const PoseGraph& graph, int count,
                                               std::uint32_t seed);

/// The same in mutually consistent groups of up to 20: two sections of the trajectory are
/// associated as if they were one, as happens in parallel corridors, with one loop closure per pair
/// of nodes.
std::vector<PoseConstraint> consistent_wrong_loops(const PoseGraph& graph, int count,
                                                   std::uint32_t seed);

}  // namespace adit::test
