// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/path_cost.hpp"

namespace adit {

/// The A* heuristic: a lower bound on the cost from each cell to the best end, or kUnreachable.
/// Dijkstra's algorithm over cells and their eight neighbours, from all goals simultaneously, with
/// the minimum cost of each cell over all headings. The bound is consistent: each primitive sweeps
/// a chain of neighbouring cells and costs at least as much as this search charges for that chain.
std::vector<std::int32_t> cell_heuristic(const Lattice& lattice, const GoalArray& goals,
                                         double cell_m);

}  // namespace adit
