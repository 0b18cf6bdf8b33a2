// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/world/plan/tunnel_line.hpp"
#include "sim/world/world_truth.hpp"

namespace adit {

/// The centre lines of the tunnels as a graph: split where lines cross, or where one ends within
/// half a width of another; it is then extended to the centre line of the other. Nodes less than 1
/// m apart are merged. Lines of different levels meet only where both end (LevelPlan).
TunnelGraph tunnel_graph(const std::vector<TunnelLine>& tunnels);

}  // namespace adit
