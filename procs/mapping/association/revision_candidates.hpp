// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "procs/mapping/association/trial.hpp"

namespace adit {

/// Decisions that may be wrong if a closure that contradicts the map is right.
struct RevisionCandidate {
  std::vector<int> loop_closures;  ///< chosen now, in ascending order
  /// The least that a belief can cost in which these are undone, as far as is known: the closures
  /// that would be given up against those that contradict them and agree with the new one.
  double bound = 0.0;
};

/// Sets of decisions to be undone for the sake of one alternative of a closure that is left out:
///   – the chosen closures that contradict it, going around by both and the way;
///   – single ones without which it would be likely, and with them their groups.
/// Those that could not pay, by their bound against `cost`, are left out.
std::vector<RevisionCandidate> revision_candidates(const AssociationProblem& problem, Trial& trial,
                                                   int loop_closure, double gate, double cost);

/// For the paper's order of search: the group of the latest decision, then also the one before it,
/// and so on, at most `most` times.
std::vector<RevisionCandidate> latest_groups(const AssociationProblem& problem, const Trial& trial,
                                             int most);

}  // namespace adit
