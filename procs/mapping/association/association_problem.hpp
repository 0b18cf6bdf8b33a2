// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/association/odometry_chain.hpp"

namespace adit {

/// The input of data association: the chain of local maps, which is certain, and the loop closures,
/// which are to be decided.
struct AssociationProblem {
  std::vector<PoseConstraint> chain;       ///< chain[k] links map k with map k + 1
  OdometryChain odometry;                  ///< the same displacements, composed
  std::vector<LoopClosure> loop_closures;  ///< in order of their newer map
  /// Group of each loop closure. Loop closures of a group are adjacent at both ends, and so are
  /// likely to be correct or wrong together.
  std::vector<int> groups;
  std::vector<bool> plausible;  ///< of each loop closure: whether the odometry alone allows it
  int group_count = 0;

  /// The size of the problem at some time.
  struct Checkpoint {
    int maps = 0;
    std::size_t loop_closures = 0;
    int group_count = 0;
  };
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Removes the maps and loop closures added since the checkpoint. Returns these loop closures.
  std::vector<LoopClosure> roll_back(const Checkpoint& checkpoint);
};

/// The constraint of an alternative of a closure.
inline PoseConstraint constraint_of(const LoopClosure& loop_closure, int alternative) {
  const LoopClosureAlternative& a =
      loop_closure.alternatives[static_cast<std::size_t>(alternative)];
  return {a.older_map, loop_closure.newer_map, a.T_older_newer, a.information};
}

/// By how much an alternative is less likely than the best of its closure, as −2 log-likelihood.
inline double penalty(const LoopClosure& loop_closure, int alternative) {
  return 2.0 * (loop_closure.alternatives.front().log_likelihood -
                loop_closure.alternatives[static_cast<std::size_t>(alternative)].log_likelihood);
}

/// One set of decisions and what follows from it: a leaf of the tree of decisions.
struct Hypothesis {
  std::vector<int> chosen;         ///< of each closure: an alternative, or Association::kNone
  std::vector<Pose2> T_map_local;  ///< where the maps then are
  double objective = 0.0;          ///< Σ eᵀ R e over the chain and the chosen alternatives
  /// −2 log-likelihood, up to a constant: `objective` and that of the decisions.
  double cost = 0.0;
  /// Some maps were held where they were though closures pull at them.
  bool partially_optimized = false;
};

/// The constraints of the alternatives that are chosen, in the order of their closures.
std::vector<PoseConstraint> constraints_in_force(const AssociationProblem& problem,
                                                 const Hypothesis& hypothesis);

/// A constraint between maps as one between the nodes of `graph_of(problem, belief, first)`; its
/// later map is not before `first`.
PoseConstraint in_graph_from(const PoseConstraint& constraint, const Hypothesis& hypothesis,
                             int first);

/// The graph of a belief, from map `first` on: node 0 is the frame of map, in which the maps before
/// `first` stay where they are, node 1 is map `first`. With `first` 0, the whole graph as it is.
PoseGraph graph_of(const AssociationProblem& problem, const Hypothesis& hypothesis, int first = 0);

}  // namespace adit
