// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/lazy_loop_closures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/loop_order.hpp"

namespace adit {
namespace {

constexpr double kKernel2 = 7.8;  // chi-square, 3 degrees of freedom, 0.95: weight 1/4
// Loop closures decided together; more where they agree, fewer where they do not.
constexpr std::size_t kBatchFirst = 16;
constexpr std::size_t kBatchMax = 1024;
constexpr std::size_t kNoiseGrowth = 2;  // of the accepted loops between estimates of their noise
constexpr int kReweightings = 30;
constexpr double kConvergedShare = 1e-4;  // relative change of the objective

/// The constraints of the odometry chain and those of loops.
struct ConstraintSplit {
  std::vector<int> chain;  // constraint from each node to the next, or −1
  std::vector<int> loops;  // in the order of their later node
};

ConstraintSplit split(const PoseGraph& graph) {
  ConstraintSplit parts;
  parts.chain.assign(graph.poses.empty() ? 0 : graph.poses.size() - 1, -1);
  for (int k = 0; k < static_cast<int>(graph.constraints.size()); ++k) {
    const PoseConstraint& c = graph.constraints[as_index(k)];
    const bool step = std::abs(c.to - c.from) == 1;
    int* slot = step ? &parts.chain[as_index(std::min(c.from, c.to))] : nullptr;
    if (step && *slot < 0) {
      *slot = k;
    } else {
      parts.loops.push_back(k);
    }
  }
  std::stable_sort(parts.loops.begin(), parts.loops.end(), [&](int a, int b) {
    const auto later = [&](int k) {
      return std::max(graph.constraints[as_index(k)].from, graph.constraints[as_index(k)].to);
    };
    return later(a) < later(b);
  });
  return parts;
}

/// The same measurement as a constraint from the earlier to the later node.
PoseConstraint forward(const PoseConstraint& c) {
  if (c.from < c.to) return c;
  const Eigen::Matrix3d Ad = adjoint(c.T_from_to.inverse());
  return {c.to, c.from, c.T_from_to.inverse(), Ad.transpose() * c.information * Ad};
}

/// The nodes that loops touch, with the odometry between them composed to single steps.
class CondensedChain {
 public:
  CondensedChain(const PoseGraph& graph, const ConstraintSplit& parts)
      : node_(graph.poses.size(), -1) {
    std::vector<bool> selected(graph.poses.size(), false);
    if (!selected.empty()) selected.front() = true;
    for (const int k : parts.loops) {
      selected[as_index(graph.constraints[as_index(k)].from)] = true;
      selected[as_index(graph.constraints[as_index(k)].to)] = true;
    }
    int next = 0;
    for (std::size_t i = 0; i < selected.size(); ++i) {
      if (selected[i]) node_[i] = next++;
    }
  }

  [[nodiscard]] int node(int pose) const { return node_[as_index(pose)]; }

  /// The constraint as a loop closure with one alternative.
  [[nodiscard]] LoopClosure loop_closure(const PoseGraph& graph, int constraint) const {
    const PoseConstraint loop = forward(graph.constraints[as_index(constraint)]);
    LoopClosure loop_closure;
    loop_closure.newer_map = node(loop.to);
    loop_closure.alternatives = {{node(loop.from), loop.T_from_to, loop.information, 0.0}};
    return loop_closure;
  }

  void add_odometry(const PoseGraph& graph, const ConstraintSplit& parts,
                    LazyAssociation& association) const {
    UncertainPose T_last_here;
    for (std::size_t i = 0; i < node_.size(); ++i) {
      if (i > 0) {
        const PoseConstraint& step = graph.constraints[as_index(parts.chain[i - 1])];
        T_last_here = T_last_here * measured_by(forward(step));
      }
      if (node_[i] < 0) continue;
      const Eigen::Matrix3d& covariance = T_last_here.covariance;
      association.add_map(T_last_here.T_from_to, i > 0 ? covariance.inverse() : covariance);
      T_last_here = {};
    }
  }

 private:
  std::vector<int> node_;  // of each pose, or −1
};

/// The loops with their groups, in the order in which they are decided.
class LoopSource {
 public:
  LoopSource(const PoseGraph& graph, const ConstraintSplit& parts, const CondensedChain& chain,
             const AssociationProblem& problem, const LazyAssociationParams& params)
      : problem_(problem), gate_(params.gate), in_time_order_(!params.best_first) {
    std::vector<PoseConstraint> constraints;
    for (const int k : parts.loops) {
      LoopClosure loop_closure = chain.loop_closure(graph, k);
      const int group =
          group_near(problem.odometry, loop_closures_, groups_, loop_closure, params.group_gap_m);
      groups_.push_back(group >= 0 ? group : static_cast<int>(members_.size()));
      if (group < 0) members_.emplace_back();
      members_[as_index(groups_.back())].push_back(static_cast<int>(loop_closures_.size()));
      constraints.push_back(constraint_of(loop_closure, 0));
      loop_closures_.push_back(std::move(loop_closure));
    }
    if (!in_time_order_) order_.emplace(problem.chain, std::move(constraints));
  }

  [[nodiscard]] std::size_t pending() const {
    return in_time_order_ ? loop_closures_.size() - next_ : order_->pending();
  }
  [[nodiscard]] const LoopClosure& loop_closure(int i) const { return loop_closures_[as_index(i)]; }
  [[nodiscard]] int group(int i) const { return groups_[as_index(i)]; }

  /// The loops to decide next, at most `most`; none if all others are postponed.
  std::vector<int> next(std::size_t most, const std::vector<int>& accepted,
                        LazyAssociation& association) {
    if (in_time_order_) return next_in_time(most);
    const std::vector<int> candidates = order_->most_certain(most, accepted);
    std::vector<int> next;
    std::vector<int> uncertain;
    for (const int i : candidates) {
      const double chance = association.chance(loop_closure(i));
      if (chance < kChanceMax) next.push_back(i);
      if (chance >= kChanceMax && association.is_evidence(chance)) uncertain.push_back(i);
    }
    if (next.empty()) next = best_supported(candidates);
    if (next.empty()) next = uncertain;
    if (next.size() > most) next.resize(most);
    order_->take(next);
    return next;
  }

  /// The loops that are not decided.
  [[nodiscard]] std::vector<int> postponed() const {
    std::vector<int> loops;
    for (int i = 0; i < static_cast<int>(loop_closures_.size()) && !in_time_order_; ++i) {
      if (order_->is_pending(i)) loops.push_back(i);
    }
    return loops;
  }

 private:
  std::vector<int> next_in_time(std::size_t most) {
    std::vector<int> next;
    while (next.size() < most && next_ < loop_closures_.size()) {
      next.push_back(static_cast<int>(next_++));
    }
    return next;
  }

  /// Where the map cannot tell a wrong loop: of the groups of these loops, the pending loops of the
  /// one that agrees most within itself.
  [[nodiscard]] std::vector<int> best_supported(const std::vector<int>& candidates) const {
    std::vector<int> best;
    std::set<int> groups;
    for (const int i : candidates) {
      if (!groups.insert(group(i)).second) continue;
      std::vector<int> members = agreeing_members(group(i));
      if (members.size() > std::max<std::size_t>(best.size(), 1)) best = std::move(members);
    }
    return best;
  }

  /// The pending loops of a group that agree with more than half of it.
  [[nodiscard]] std::vector<int> agreeing_members(int group) const {
    const std::vector<int>& members = members_[as_index(group)];
    std::vector<int> agreeing;
    for (const int i : members) {
      if (!order_->is_pending(i)) continue;
      const auto support = std::ranges::count_if(members, [&](int j) {
        return j != i && cycle_residual(problem_.odometry, constraint_of(loop_closure(i), 0),
                                        constraint_of(loop_closure(j), 0))
                                 .disagreement < gate_;
      });
      if (2 * support >= std::ssize(members)) agreeing.push_back(i);
    }
    return agreeing;
  }

  const AssociationProblem& problem_;
  double gate_;
  bool in_time_order_;
  std::size_t next_ = 0;
  std::vector<LoopClosure> loop_closures_;
  std::vector<int> groups_;
  std::vector<std::vector<int>> members_;  // of each group
  std::optional<LoopOrder> order_;
};

/// The accepted constraints, at full weight.
struct AcceptedConstraints {
  AcceptedConstraints(const PoseGraph& graph, const std::vector<bool>& accepted) {
    std::vector<bool> loop(graph.constraints.size(), false);
    for (const int k : split(graph).loops) loop[as_index(k)] = true;
    for (std::size_t k = 0; k < graph.constraints.size(); ++k) {
      if (!accepted[k]) continue;
      constraints.push_back(graph.constraints[k]);
      is_loop.push_back(loop[k]);
    }
  }

  /// Sets the weights of the loops according to their residuals.
  void reweight(PoseGraph& weighted) const {
    for (std::size_t k = 0; k < constraints.size(); ++k) {
      if (!is_loop[k]) continue;
      const PoseConstraint& c = constraints[k];
      const double e2 =
          energy(c, residual(c, weighted.poses[as_index(c.from)], weighted.poses[as_index(c.to)]));
      const double root = 1.0 + e2 / kKernel2;
      weighted.constraints[k].information = c.information / (root * root);
    }
  }

  std::vector<PoseConstraint> constraints;
  std::vector<bool> is_loop;
};

bool has_poses(const OptimizeResult& result) {
  return result.converged || result.reason == OptimizeReason::kNotConverged;
}

/// Accumulates the counters; the other results are those of the last step.
void add(OptimizeResult& all, const OptimizeResult& step) {
  const int iterations = all.iterations + step.iterations;
  const int factorisations = all.factorisations + step.factorisations;
  all = step;
  all.iterations = iterations;
  all.factorisations = factorisations;
}

}  // namespace

LazyLoopClosuresResult associate_loops_lazily(const PoseGraph& graph,
                                              const LazyAssociationParams& params,
                                              const std::function<void(double)>& progress) {
  LazyLoopClosuresResult result;
  if (const auto gap = odometry_gap(graph)) {
    throw std::invalid_argument(
        fmt::format("no constraint leads from pose {} to the next: loops cannot be tested without "
                    "complete odometry",
                    *gap));
  }
  const ConstraintSplit parts = split(graph);
  const CondensedChain condensed_chain(graph, parts);
  LazyAssociation association(params);
  condensed_chain.add_odometry(graph, parts, association);
  std::vector<int> order;  // in which the loops of `parts` were decided
  std::size_t noise_of = kBatchFirst;  // accepted loops at the last estimate of their noise
  LoopSource loops(graph, parts, condensed_chain, association.problem(), params);
  std::size_t batch = params.best_first ? kBatchFirst : 1;
  std::vector<int> accepted;  // of the loops of `parts`
  const auto take = [&](const std::vector<int>& next) {
    std::vector<LoopClosure> loop_closures;
    std::vector<int> groups;
    for (const int i : next) {
      loop_closures.push_back(loops.loop_closure(i));
      groups.push_back(loops.group(i));
      result.constraint_of_loop_closure.push_back(parts.loops[as_index(i)]);
      order.push_back(i);
    }
    return std::pair{std::move(loop_closures), std::move(groups)};
  };
  const auto record = [&](const std::vector<Association>& decided) {
    result.history.insert(result.history.end(), decided.begin(), decided.end());
    if (progress) {
      progress(static_cast<double>(order.size()) / static_cast<double>(parts.loops.size()));
    }
  };
  while (loops.pending() > 0) {
    const std::vector<int> next = loops.next(batch, accepted, association);
    if (next.empty()) break;
    const int disagreements = association.disagreements();
    auto [loop_closures, groups] = take(next);
    record(association.decide(std::move(loop_closures), groups, 0));
    accepted.clear();
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (association.hypothesis().chosen[k] != Association::kNone) accepted.push_back(order[k]);
    }
    if (!params.best_first) continue;
    if (accepted.size() >= kNoiseGrowth * noise_of) {
      noise_of = accepted.size();
      association.estimate_noise();
    }
    const bool agreed = association.disagreements() == disagreements;
    batch = agreed ? std::min(2 * batch, kBatchMax) : std::max(batch / 2, kBatchFirst);
  }
  const std::vector<int> postponed = loops.postponed();
  if (!postponed.empty()) {
    auto [loop_closures, groups] = take(postponed);
    record(association.postpone(std::move(loop_closures), groups, 0));
  }
  if (params.best_first) association.estimate_noise();
  const auto reconsidered = association.reconsider(0);
  result.history.insert(result.history.end(), reconsidered.begin(), reconsidered.end());
  result.accepted.assign(graph.constraints.size(), true);
  for (std::size_t i = 0; i < result.constraint_of_loop_closure.size(); ++i) {
    result.accepted[as_index(result.constraint_of_loop_closure[i])] =
        association.hypothesis().chosen[i] != Association::kNone;
  }
  result.trials = association.trials();
  return result;
}

std::optional<int> odometry_gap(const PoseGraph& graph) {
  const std::vector<int> chain = split(graph).chain;
  const auto gap = std::find(chain.begin(), chain.end(), -1);
  if (gap == chain.end()) return std::nullopt;
  return static_cast<int>(gap - chain.begin());
}

OptimizeResult optimize_accepted(PoseGraph& graph, const std::vector<bool>& accepted,
                                 const OptimizeObserver& observer) {
  const AcceptedConstraints full(graph, accepted);
  PoseGraph weighted{graph.poses, full.constraints};
  OptimizeParams params;
  OptimizeResult all;
  double last = 0.0;
  for (int i = 0; i < kReweightings; ++i) {
    if (i > 0) full.reweight(weighted);
    const OptimizeResult step = optimize(weighted, params, observer);
    if (observer) observer(OptimizePhase::kOther);
    add(all, step);
    if (!has_poses(step)) return all;
    params.rotation_initialization = false;
    if (i > 0 && std::abs(step.objective - last) <= kConvergedShare * last) break;
    last = step.objective;
  }
  graph.poses = std::move(weighted.poses);
  all.objective = objective({graph.poses, full.constraints});
  if (observer) observer(OptimizePhase::kEnd);
  return all;
}

}  // namespace adit
