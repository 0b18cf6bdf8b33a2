// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose_graph/normal_equations.hpp"

namespace adit {

/// Orientations of all nodes from the measured rotations alone, independent of the poses [rad]. The
/// problem is linear once the number of turns of each loop is known: the multiples of 2π are taken
/// from a spanning tree of the most certain rotations (Carlone, Aragues, Castellanos, Bona, "A fast
/// and accurate approximation for planar pose graph optimization", IJRR 2014), and updated from the
/// solution until they are stable. The weight of a constraint is its information on the rotation
/// with the translation marginalised (the Schur complement). Node 0 keeps its orientation. The
/// graph is connected.
std::vector<double> solve_rotations(const PoseGraph& graph, const GraphStructure& structure);

/// Initial poses from which the iteration converges where it would not from odometry: orientations
/// as above, then all poses by one linear step with measured lever arms, which also corrects the
/// rotations. One scalar and one full factorisation. False, with the graph unchanged: the
/// constraints do not determine all poses; `equations.matrix().weakest_block()` names the block.
[[nodiscard]] bool initialize_from_rotations(PoseGraph& graph, const GraphStructure& structure,
                                             NormalEquations& equations);

}  // namespace adit
