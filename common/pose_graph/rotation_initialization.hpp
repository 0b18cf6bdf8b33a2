// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose_graph/normal_equations.hpp"

namespace adit {

/// Orientations of all nodes from the measured rotations alone, whatever the poses are [rad]. The
/// problem is linear once it is known how often each loop winds: the multiples of 2π are taken from
/// a spanning tree of the most certain rotations (Carlone, Aragues, Castellanos, Bona, "A fast and
/// accurate approximation for planar pose graph optimization", IJRR 2014), and taken again from the
/// solution until they stay. What a constraint knows of the rotation whatever the translation is
/// (the Schur complement) is its weight. Node 0 keeps its orientation. The graph is connected.
std::vector<double> solve_rotations(const PoseGraph& graph, const GraphStructure& structure);

/// Poses from which iteration reaches the optimum where it would not from odometry: orientations as
/// above, then all poses by one linear step, with the rotations that translations ask for, in which
/// lever arms are as measured. One scalar and one full factorisation. False: the constraints do not
/// determine all poses; `equations.matrix().weakest_block()` says which, and the graph is as it
/// was.
[[nodiscard]] bool initialize_from_rotations(PoseGraph& graph, const GraphStructure& structure,
                                             NormalEquations& equations);

}  // namespace adit
