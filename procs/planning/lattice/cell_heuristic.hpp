// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {

inline constexpr std::int32_t kUnreachable = std::numeric_limits<std::int32_t>::max();

/// A lower bound on what it costs to drive from each cell to the best end, or kUnreachable:
/// Dijkstra's search over cells and their eight neighbours, from all goals at once, at the least
/// cost over all headings. Consistent: each primitive comes through a chain of neighbouring cells,
/// and costs at least what this search takes for that chain.
std::vector<std::int32_t> cell_heuristic(const Lattice& lattice, const GoalField& goals,
                                         double cell_m);

}  // namespace adit
