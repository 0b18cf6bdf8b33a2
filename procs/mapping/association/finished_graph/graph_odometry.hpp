// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/odometry_chain.hpp"

namespace adit {

/// The same measurement as a constraint from the earlier to the later node.
PoseConstraint forward(const PoseConstraint& constraint);

/// The constraints of a graph from a file that are odometry, and the loops, by their indices. The
/// first constraint between each pose and the next that determines their relative pose is odometry.
/// Where there is none, the odometry has a gap. Constraints between other poses then bridge the
/// gaps, so that both together are a spanning tree: of those between two parts, the one with which
/// most others agree, and where they are equal that of the nearest poses. Bridges are not doubted.
struct GraphOdometry {
  /// `gate`: up to which disagreement two constraints agree. Throws std::invalid_argument if the
  /// graph is not connected.
  GraphOdometry(const PoseGraph& graph, double gate);

  std::vector<int> chain;    ///< constraint from each pose to the next, or −1: a gap
  std::vector<int> bridges;  ///< as many as there are gaps
  std::vector<int> loops;    ///< all others, in the order of their later pose

  /// The displacement from each pose to the next; over a gap composed along the bridges.
  std::vector<UncertainPose> steps;
};

}  // namespace adit
