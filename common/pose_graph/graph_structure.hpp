// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "common/pose_graph/sparse_cholesky.hpp"

namespace adit {

/// Who is linked with whom, and the order of elimination that follows: all that depends on neither
/// poses nor measurements. Pose 0 is held fixed (a field of relative measurements says nothing of
/// where the whole lies), so that node i is block i − 1.
struct GraphStructure {
  BlockPattern pattern;
  BlockOrdering ordering;
  std::vector<int> pair_of_constraint;  ///< in the pattern, or −1 if it is with pose 0
};

/// One symbolic analysis. The graph has at least two poses.
GraphStructure analyse(const PoseGraph& graph);

/// The first node that no chain of constraints links with node 0.
std::optional<int> first_unconnected_node(const PoseGraph& graph);

}  // namespace adit
