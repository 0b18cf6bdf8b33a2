// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "procs/planning/lattice/lattice.hpp"
#include "procs/planning/path_cost.hpp"

namespace adit {

struct SearchParams {
  double direction_change_m = 1.0;  ///< cost of a change of direction, as metres of even ground
  int expansions_max = 400000;      ///< maximum number of expanded states

  template <class V>
  void visit(V& v) {
    v("direction_change_m", direction_change_m, within(0.0, 100.0));
    v("expansions_max", expansions_max, at_least(1.0));
  }
};

/// A path through the lattice, as a sequence of primitives.
struct LatticePath {
  bool found = false;
  bool abandoned = false;                     ///< the maximum number of expansions was reached
  std::int64_t cost = 0;                      ///< total, with that of the end (path_cost.hpp)
  int expansions = 0;                         ///< number of expanded states
  std::vector<const MotionPrimitive*> steps;  ///< in the MotionPrimitives of the lattice
  std::vector<std::int32_t> costs;            ///< from the start to the end of each step
};

/// The path of minimum cost from a pose to any of the goals: A* (Hart, Nilsson and Raphael, 1968)
/// over cell, heading and direction of travel (section 3.3 of the paper). The search ends when no
/// open state can improve on the best end so far. `heuristic` is a consistent lower bound for each
/// cell, or kUnreachable; zeros yield Dijkstra's algorithm. Ties in f are broken by h and then by
/// an order of the states that is the same in a scene and in its mirror image.
LatticePath search_lattice(const Lattice& lattice, const HeadingSet& headings,
                           const LatticePose& start, const GoalArray& goals,
                           const std::vector<std::int32_t>& heuristic, const SearchParams& params);

}  // namespace adit
