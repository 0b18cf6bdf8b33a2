// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/association_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace adit {
namespace {

/// A constraint in the graph that begins with map `first`; the maps before are fixed in node 0.
PoseConstraint shifted(const PoseConstraint& c, const Hypothesis& hypothesis, int first) {
  PoseConstraint moved = c;
  moved.to = c.to - first + 1;
  moved.from = c.from - first + 1;
  if (c.from < first) {
    moved.from = 0;
    moved.T_from_to = hypothesis.T_map_local[static_cast<std::size_t>(c.from)] * c.T_from_to;
  }
  return moved;
}

}  // namespace

AssociationProblem::Checkpoint AssociationProblem::checkpoint() const {
  return {odometry.maps(), loop_closures.size(), group_count()};
}

std::vector<LoopClosure> AssociationProblem::roll_back(const Checkpoint& checkpoint) {
  chain.resize(static_cast<std::size_t>(std::max(0, checkpoint.maps - 1)));
  odometry.truncate(checkpoint.maps);
  std::erase_if(gaps, [&](int step) { return step + 1 >= checkpoint.maps; });
  std::erase_if(bridges, [&](const PoseConstraint& c) { return c.to >= checkpoint.maps; });
  const auto first = loop_closures.begin() + static_cast<std::ptrdiff_t>(checkpoint.loop_closures);
  std::vector<LoopClosure> removed(std::make_move_iterator(first),
                                   std::make_move_iterator(loop_closures.end()));
  loop_closures.erase(first, loop_closures.end());
  groups.resize(checkpoint.loop_closures);
  plausible.resize(checkpoint.loop_closures);
  members.resize(as_index(checkpoint.group_count));
  for (std::vector<int>& group : members) {
    std::erase_if(group, [&](int k) { return as_index(k) >= checkpoint.loop_closures; });
  }
  return removed;
}

void AssociationProblem::add_to_group(int group) {
  if (group >= group_count()) members.resize(as_index(group) + 1);
  members[as_index(group)].push_back(static_cast<int>(groups.size()));
  groups.push_back(group);
}

int group_near(const OdometryChain& odometry, const std::vector<LoopClosure>& loop_closures,
               const std::vector<int>& groups, const LoopClosure& loop_closure, double gap_m) {
  const auto newer_m = [&](const LoopClosure& c) { return odometry.length_m(c.newer_map); };
  const auto older_m = [&](const LoopClosure& c) {
    return odometry.length_m(c.alternatives.front().older_map);
  };
  for (std::size_t k = loop_closures.size(); k-- > 0;) {
    const LoopClosure& other = loop_closures[k];
    if (newer_m(loop_closure) - newer_m(other) > gap_m) break;
    if (std::abs(older_m(loop_closure) - older_m(other)) <= gap_m) return groups[k];
  }
  return -1;
}

std::vector<PoseConstraint> constraints_in_force(const AssociationProblem& problem,
                                                 const Hypothesis& hypothesis) {
  std::vector<PoseConstraint> constraints;
  for (std::size_t k = 0; k < hypothesis.chosen.size(); ++k) {
    if (hypothesis.chosen[k] == Association::kNone) continue;
    constraints.push_back(constraint_of(problem.loop_closures[k], hypothesis.chosen[k]));
  }
  return constraints;
}

PoseConstraint in_graph_from(const PoseConstraint& constraint, const Hypothesis& hypothesis,
                             int first) {
  return first == 0 ? constraint : shifted(constraint, hypothesis, first);
}

PoseGraph graph_of(const AssociationProblem& problem, const Hypothesis& hypothesis, int first) {
  PoseGraph graph;
  if (first > 0) graph.poses.emplace_back();
  graph.poses.insert(graph.poses.end(), hypothesis.T_map_local.begin() + first,
                     hypothesis.T_map_local.end());
  const auto add = [&](const PoseConstraint& c) {
    if (c.to >= first) graph.constraints.push_back(in_graph_from(c, hypothesis, first));
  };
  auto gap = std::ranges::lower_bound(problem.gaps, first - 1);
  for (auto step = as_index(std::max(0, first - 1)); step < problem.chain.size(); ++step) {
    const bool is_gap = gap != problem.gaps.end() && as_index(*gap) == step;
    if (is_gap) ++gap;
    if (!is_gap) add(problem.chain[step]);
  }
  for (const PoseConstraint& c : problem.bridges) add(c);
  for (const PoseConstraint& c : constraints_in_force(problem, hypothesis)) add(c);
  return graph;
}

}  // namespace adit
