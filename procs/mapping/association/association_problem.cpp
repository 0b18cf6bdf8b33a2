// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/association_problem.hpp"

namespace adit {

PoseGraph graph_of(const AssociationProblem& problem, const Belief& belief) {
  PoseGraph graph{belief.T_map_local, problem.chain};
  for (std::size_t k = 0; k < belief.chosen.size(); ++k) {
    if (belief.chosen[k] == Association::kNone) continue;
    graph.constraints.push_back(constraint_of(problem.closures[k], belief.chosen[k]));
  }
  return graph;
}

}  // namespace adit
