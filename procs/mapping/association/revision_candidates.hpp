// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "procs/mapping/association/trial.hpp"

namespace adit {

/// Decisions that may be wrong if a loop closure that contradicts the map is correct.
struct RevisionCandidate {
  std::vector<int> loop_closures;  ///< currently chosen, in ascending order
  /// Estimated lower bound of the cost of a hypothesis without them: the cost of rejecting these,
  /// minus the gain from loop closures that contradict them and agree with the new one.
  double bound = 0.0;
};

/// Sets of decisions to revoke in favour of one rejected loop closure:
///   – the chosen loop closures that contradict it, in the cycle of both and the odometry;
///   – single loop closures without which it would be likely, and their groups.
/// Sets whose bound is not below `cost` are discarded. Best bound first.
std::vector<RevisionCandidate> revision_candidates(const AssociationProblem& problem, Trial& trial,
                                                   int loop_closure, double gate, double cost);

/// The candidates of the paper's order of search (section 2.2): the group of the latest decision,
/// then also the group before it, and so on, at most `most` times.
std::vector<RevisionCandidate> latest_groups(const AssociationProblem& problem, const Trial& trial,
                                             int most);

}  // namespace adit
