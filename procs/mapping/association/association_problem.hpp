// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/association/odometry_chain.hpp"

namespace adit {

/// An id of a local map or a loop closure as an index of a container.
inline std::size_t as_index(int id) { return static_cast<std::size_t>(id); }

/// A fit that is more likely than this to occur by chance is no evidence.
constexpr double kChanceMax = 0.05;

/// The input of data association: the chain of local maps, which is certain, and the loop closures,
/// which are to be decided. Where the chain has gaps, constraints between other maps bridge them.
struct AssociationProblem {
  std::vector<PoseConstraint> chain;  ///< chain[k] links map k with map k + 1
  /// Steps of the chain that nothing measured, ascending: composed along the bridges, for tests of
  /// cycles and for the order of decisions, but not part of the graph.
  std::vector<int> gaps;
  std::vector<PoseConstraint> bridges;     ///< certain, like the chain, which they link over gaps
  OdometryChain odometry;                  ///< the displacements of the chain, composed
  std::vector<LoopClosure> loop_closures;  ///< in order of their newer map
  /// Group of each loop closure. Loop closures of a group are adjacent at both ends, and so are
  /// likely to be correct or wrong together.
  std::vector<int> groups;
  std::vector<std::vector<int>> members;  ///< loop closures of each group, in order
  std::vector<bool> plausible;  ///< of each loop closure: whether the odometry alone allows it

  [[nodiscard]] int group_count() const { return static_cast<int>(members.size()); }
  [[nodiscard]] const std::vector<int>& members_of_group_of(int loop_closure) const {
    return members[as_index(groups[as_index(loop_closure)])];
  }
  /// Puts the next loop closure into a group, a new one from the number of groups on.
  void add_to_group(int group);

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

/// The group of the latest of these loop closures, in order of their newer map, that is within
/// `gap_m` of another one along the odometry at both ends; −1 if there is none.
int group_near(const OdometryChain& odometry, const std::vector<LoopClosure>& loop_closures,
               const std::vector<int>& groups, const LoopClosure& loop_closure, double gap_m);

/// The constraint of an alternative of a loop closure.
inline PoseConstraint constraint_of(const LoopClosure& loop_closure, int alternative) {
  const LoopClosureAlternative& a =
      loop_closure.alternatives[static_cast<std::size_t>(alternative)];
  return {a.older_map, loop_closure.newer_map, a.T_older_newer, a.information};
}

/// How much less likely an alternative is than the best of its loop closure: −2 log-likelihood
/// ratio.
inline double penalty(const LoopClosure& loop_closure, int alternative) {
  return 2.0 * (loop_closure.alternatives.front().log_likelihood -
                loop_closure.alternatives[static_cast<std::size_t>(alternative)].log_likelihood);
}

/// A set of decisions and the resulting map: a leaf of the tree of decisions.
struct Hypothesis {
  std::vector<int> chosen;         ///< of each loop closure: an alternative, or Association::kNone
  std::vector<Pose2> T_map_local;  ///< resulting poses of the local maps
  double objective = 0.0;          ///< Σ eᵀ R e over the chain and the chosen alternatives
  /// −2 log-likelihood up to a constant: `objective` plus the cost of the decisions.
  double cost = 0.0;
  /// Some maps were held fixed although loop closures link them to maps that moved.
  bool partially_optimized = false;
};

/// The constraints of the chosen alternatives, in the order of their loop closures.
std::vector<PoseConstraint> constraints_in_force(const AssociationProblem& problem,
                                                 const Hypothesis& hypothesis);

/// A constraint between maps as a constraint between nodes of `graph_of(problem, hypothesis,
/// first)`; its later map is not before `first`.
PoseConstraint in_graph_from(const PoseConstraint& constraint, const Hypothesis& hypothesis,
                             int first);

/// The pose graph of a hypothesis from map `first` on: node 0 is the map frame, to which the maps
/// before `first` are fixed, node 1 is map `first`. With `first` 0, the complete graph.
PoseGraph graph_of(const AssociationProblem& problem, const Hypothesis& hypothesis, int first = 0);

}  // namespace adit
