// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Where a drift is split at a node: the place along it, and that of the node.
struct TunnelSplit {
  double s_m = 0.0;                  ///< along the drift
  Eigen::Vector2d p_node{0.0, 0.0};  ///< p_world [m]
};

/// For each drift, in no particular order: where it crosses itself or another, where another ends
/// within half its width, and its own ends.
std::vector<std::vector<TunnelSplit>> tunnel_splits(const std::vector<TunnelLine>& tunnels);

/// The middles of the drifts as a graph: split where lines cross, or where one ends within half a
/// width of another, to the middle of which it is then led. Nodes less than a metre apart are one.
TunnelGraph tunnel_graph(const std::vector<TunnelLine>& tunnels);

}  // namespace adit
