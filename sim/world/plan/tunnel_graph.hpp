// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// Where a tunnel is split at a node: the distance along it, and the position of the node.
struct TunnelSplit {
  double s_m = 0.0;                  ///< along the tunnel
  Eigen::Vector2d p_node{0.0, 0.0};  ///< p_world [m]
};

/// For each tunnel, unordered: where it crosses itself or another, where another ends within half
/// of its width, and its own ends.
std::vector<std::vector<TunnelSplit>> tunnel_splits(const std::vector<TunnelLine>& tunnels);

/// The centre lines of the tunnels as a graph: split where lines cross, or where one ends within
/// half a width of another; it is then extended to the centre line of the other. Nodes less than 1
/// m apart are merged.
TunnelGraph tunnel_graph(const std::vector<TunnelLine>& tunnels);

}  // namespace adit
