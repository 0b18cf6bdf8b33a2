// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/loop_queue.hpp"

#include <algorithm>
#include <set>

namespace adit {
namespace {

constexpr double kChanceFurtherMax = 1e-4;  // of less certain loops that are decided with the next

}  // namespace

LoopQueue::LoopQueue(std::vector<LoopClosure> loop_closures, LazyAssociation& association,
                     const LazyAssociationParams& params)
    : association_(association), gate_(params.gate) {
  std::vector<PoseConstraint> constraints;
  for (LoopClosure& loop_closure : loop_closures) {
    const int group = group_near(association.problem().odometry, loop_closures_, groups_,
                                 loop_closure, params.group_gap_m);
    groups_.push_back(group >= 0 ? group : static_cast<int>(members_.size()));
    if (group < 0) members_.emplace_back();
    members_[as_index(groups_.back())].push_back(static_cast<int>(loop_closures_.size()));
    constraints.push_back(constraint_of(loop_closure, 0));
    loop_closures_.push_back(std::move(loop_closure));
  }
  const AssociationProblem& problem = association.problem();
  if (params.best_first) order_.emplace(problem.chain, problem.bridges, std::move(constraints));
}

std::pair<std::vector<LoopClosure>, std::vector<int>> LoopQueue::with_groups(
    const std::vector<int>& loops) const {
  std::pair<std::vector<LoopClosure>, std::vector<int>> found;
  for (const int i : loops) {
    found.first.push_back(loop_closures_[as_index(i)]);
    found.second.push_back(groups_[as_index(i)]);
  }
  return found;
}

std::vector<int> LoopQueue::next(std::size_t most) {
  if (!order_) return next_in_time(most);
  const auto [candidates, further] = order_->most_certain(most, accepted_);
  std::vector<int> next;
  std::vector<int> uncertain;
  for (const int i : candidates) {
    const double chance = association_.chance(loop_closures_[as_index(i)]);
    if (chance < kChanceMax) next.push_back(i);
    if (chance >= kChanceMax && association_.is_evidence(chance)) uncertain.push_back(i);
  }
  // A batch costs as much as the whole graph: where the next would fit hardly by chance, few
  // suffice.
  for (const int i : further) {
    if (!next.empty() && association_.chance(loop_closures_[as_index(i)]) < kChanceFurtherMax)
      next.push_back(i);
  }
  if (next.empty()) next = best_supported(candidates);
  if (next.empty()) next = uncertain;
  if (next.size() > most) next.resize(most);
  order_->take(next);
  return next;
}

std::vector<int> LoopQueue::remaining() const {
  std::vector<int> loops;
  for (int i = static_cast<int>(next_); i < static_cast<int>(loop_closures_.size()); ++i) {
    if (!order_ || order_->is_pending(i)) loops.push_back(i);
  }
  return loops;
}

std::vector<int> LoopQueue::next_in_time(std::size_t most) {
  std::vector<int> next;
  while (next.size() < most && next_ < loop_closures_.size()) {
    next.push_back(static_cast<int>(next_++));
  }
  return next;
}

/// Of the groups of these loop closures, those of the one that agrees most within itself.
std::vector<int> LoopQueue::best_supported(const std::vector<int>& candidates) const {
  std::vector<int> best;
  std::set<int> groups;
  for (const int i : candidates) {
    const int group = groups_[as_index(i)];
    if (!groups.insert(group).second) continue;
    std::vector<int> members = agreeing_members(group);
    if (members.size() > std::max<std::size_t>(best.size(), 1)) best = std::move(members);
  }
  return best;
}

/// The loop closures of a group in the queue that agree with at least half of it.
std::vector<int> LoopQueue::agreeing_members(int group) const {
  const std::vector<int>& members = members_[as_index(group)];
  std::vector<int> agreeing;
  for (const int i : members) {
    if (!order_->is_pending(i)) continue;
    const auto support =
        std::ranges::count_if(members, [&](int j) { return j != i && agree(i, j); });
    if (2 * support >= std::ssize(members)) agreeing.push_back(i);
  }
  return agreeing;
}

bool LoopQueue::agree(int a, int b) const {
  return cycle_residual(association_.problem().odometry,
                        constraint_of(loop_closures_[as_index(a)], 0),
                        constraint_of(loop_closures_[as_index(b)], 0))
             .disagreement < gate_;
}

}  // namespace adit
