// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/config/bounds.hpp"
#include "procs/planning/goals/goal_field.hpp"
#include "procs/planning/lattice/lattice.hpp"

namespace adit {

struct SearchParams {
  double direction_change_m = 1.0;  ///< that changing between forwards and reverse costs, as a way
  int expansions_max = 400000;      ///< after which a search is cut off

  template <class V>
  void visit(V& v) {
    v("direction_change_m", direction_change_m, within(0.0, 100.0));
    v("expansions_max", expansions_max, at_least(1.0));
  }
};

/// A way through a lattice.
struct LatticePath {
  bool found = false;
  bool abandoned = false;
  std::int64_t cost = 0;  ///< with that of its end
  int expansions = 0;
  std::vector<const MotionPrimitive*> steps;  ///< of the MotionPrimitives of the lattice
  std::vector<std::int32_t> costs;            ///< from the start to the end of each
};

/// The best way from a pose to the best end: A* over cell, heading and direction of travel
/// (P. Hart, N. Nilsson and B. Raphael, 1968), that ends when nothing open can be better than the
/// best end met. `heuristic` is a consistent lower bound for each cell, or kUnreachable; with zeros
/// this is Dijkstra's search. Ties are broken by what is left to drive and then by the pose, in an
/// order that a scene has in common with its mirror image.
LatticePath search_lattice(const Lattice& lattice, const HeadingSet& headings,
                           const LatticePose& start, const GoalField& goals,
                           const std::vector<std::int32_t>& heuristic, const SearchParams& params);

}  // namespace adit
