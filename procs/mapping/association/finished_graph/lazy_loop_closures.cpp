// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/finished_graph/lazy_loop_closures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "common/pose_graph/pose_graph.hpp"
#include "procs/mapping/association/finished_graph/graph_odometry.hpp"
#include "procs/mapping/association/finished_graph/loop_consensus.hpp"
#include "procs/mapping/association/finished_graph/loop_queue.hpp"

namespace adit {
namespace {

constexpr double kKernel2 = 7.8;  // chi-square, 3 degrees of freedom, 0.95: weight 1/4
// Loop closures decided together; more where they agree, fewer where they do not.
constexpr std::size_t kBatchFirst = 16;
constexpr std::size_t kBatchMax = 1 << 16;
constexpr std::size_t kNoiseGrowth = 2;  // of the accepted loops between estimates of their noise
constexpr int kReweightings = 30;
constexpr double kMisfitDoubtful = 4.0;   // chi-square by its expectation
constexpr int kDoubtLoopsMin = 8;         // accepted, below which the ratio says little
constexpr double kConvergedShare = 1e-4;  // relative change of the objective

/// The nodes that loops, bridges and gaps touch, with the odometry between them composed to single
/// steps.
class CondensedChain {
 public:
  CondensedChain(const PoseGraph& graph, const GraphOdometry& odometry)
      : node_(graph.poses.size(), -1) {
    std::vector<bool> selected(graph.poses.size(), false);
    if (!selected.empty()) selected.front() = true;
    for (const auto* constraints : {&odometry.loops, &odometry.bridges}) {
      for (const int k : *constraints) {
        selected[as_index(graph.constraints[as_index(k)].from)] = true;
        selected[as_index(graph.constraints[as_index(k)].to)] = true;
      }
    }
    for (std::size_t i = 0; i < odometry.chain.size(); ++i) {
      if (odometry.chain[i] < 0) selected[i] = selected[i + 1] = true;
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

  void add_odometry(const PoseGraph& graph, const GraphOdometry& odometry,
                    LazyAssociation& association) const {
    UncertainPose T_last_here;
    for (std::size_t i = 0; i < node_.size(); ++i) {
      const bool after_gap = i > 0 && odometry.chain[i - 1] < 0;
      if (i > 0) T_last_here = T_last_here * odometry.steps[i - 1];
      if (node_[i] < 0) continue;
      const Eigen::Matrix3d& covariance = T_last_here.covariance;
      if (after_gap) {
        association.add_map_after_gap(T_last_here);
      } else {
        association.add_map(T_last_here.T_from_to, i > 0 ? covariance.inverse() : covariance);
      }
      T_last_here = {};
    }
    for (const int k : odometry.bridges) {
      const PoseConstraint c = forward(graph.constraints[as_index(k)]);
      association.add_bridge(
          {node(c.from), node(c.to), c.T_from_to, measured_by(c).covariance.inverse()});
    }
  }

 private:
  std::vector<int> node_;  // of each pose, or −1
};

/// The chi-square of a map by its expectation: the variance of unit weight of adjustment
/// computation. Nothing for too few loops.
std::optional<double> variance_factor(double objective, std::ptrdiff_t accepted) {
  if (accepted < kDoubtLoopsMin) return std::nullopt;
  return objective / (3.0 * static_cast<double>(accepted));
}

/// The accepted constraints, at full weight.
struct AcceptedConstraints {
  AcceptedConstraints(const PoseGraph& graph, const std::vector<bool>& accepted) {
    std::vector<bool> loop(graph.constraints.size(), false);
    for (const int k : GraphOdometry(graph, LazyAssociationParams{}.gate).loops) {
      loop[as_index(k)] = true;
    }
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

/// Decides the loops of a file.
class FileAssociation {
 public:
  FileAssociation(const PoseGraph& graph, const LazyAssociationParams& params)
      : graph_(graph), params_(params), odometry_(graph, params.gate), association_(params) {
    const CondensedChain chain(graph, odometry_);
    chain.add_odometry(graph, odometry_, association_);
    std::vector<LoopClosure> loop_closures;
    for (const int k : odometry_.loops) loop_closures.push_back(chain.loop_closure(graph, k));
    queue_.emplace(std::move(loop_closures), association_, params);
    result_.accepted.assign(graph.constraints.size(), true);
  }

  LazyLoopClosuresResult run(const std::function<void(double)>& progress) {
    if (params_.best_first && loses_heading(odometry_)) {
      auto consensus = find_consensus(graph_, odometry_, params_.gate);
      if (consensus && consensus->is_certified) {
        adopt(std::move(*consensus));
        if (progress && share_done() > 0.0) progress(1.0);
        return std::move(result_);
      }
      result_.doubts.emplace_back(
          "the odometry loses its heading, and its loops have no consensus with a proven optimum");
    }
    std::size_t batch = params_.best_first ? kBatchFirst : 1;
    for (auto next = queue_->next(batch); !next.empty(); next = queue_->next(batch)) {
      const int disagreements = association_.disagreements();
      auto [loop_closures, groups] = queue_->with_groups(next);
      record(next, association_.decide(std::move(loop_closures), groups, 0));
      if (progress) progress(share_done());
      if (!params_.best_first) continue;
      prepare_next();
      const bool agreed = association_.disagreements() == disagreements;
      batch = agreed ? std::min(2 * batch, kBatchMax) : std::max(batch / 2, kBatchFirst);
    }
    finish();
    if (progress && share_done() > 0.0) progress(1.0);
    return std::move(result_);
  }

 private:
  [[nodiscard]] double share_done() const {
    return static_cast<double>(order_.size()) / static_cast<double>(odometry_.loops.size() + 1);
  }

  void record(const std::vector<int>& loops, const std::vector<Association>& decided) {
    order_.insert(order_.end(), loops.begin(), loops.end());
    result_.history.insert(result_.history.end(), decided.begin(), decided.end());
  }

  void prepare_next() {
    std::vector<int> accepted;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      if (association_.hypothesis().chosen[k] != Association::kNone) accepted.push_back(order_[k]);
    }
    if (accepted.size() >= kNoiseGrowth * noise_of_) {
      noise_of_ = accepted.size();
      association_.estimate_noise();
    }
    queue_->set_accepted(std::move(accepted));
  }

  void adopt(LoopConsensus consensus) {
    const std::vector<int> all = queue_->remaining();
    std::vector<LoopClosure> loop_closures = queue_->with_groups(all).first;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int constraint = odometry_.loops[as_index(all[i])];
      const bool accepted = consensus.accepted[as_index(constraint)];
      Association decision;
      decision.loop_closure = std::move(loop_closures[i]);
      decision.loop_closure.id = static_cast<int>(i);
      decision.chosen = accepted ? 0 : Association::kNone;
      decision.reason = accepted ? "agrees with the others" : "does not agree with the others";
      record({all[i]}, {decision});
      result_.constraint_of_loop_closure.push_back(constraint);
    }
    if (consensus.is_contradictory) {
      result_.doubts.emplace_back(
          "the odometry loses its heading, and a group of accepted loops contradicts the others");
    }
    result_.accepted = std::move(consensus.accepted);
    result_.T_map_node = std::move(consensus.T_map_node);
    result_.bridges = odometry_.bridges;
  }

  void finish() {
    const std::vector<int> remaining = queue_->remaining();
    auto [loop_closures, groups] = queue_->with_groups(remaining);
    record(remaining, association_.postpone(std::move(loop_closures), groups, 0));
    if (params_.best_first) association_.estimate_noise();
    record({}, association_.reconsider(0));
    if (params_.best_first) reconsider_by_variance_factor();
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const int constraint = odometry_.loops[as_index(order_[i])];
      result_.constraint_of_loop_closure.push_back(constraint);
      result_.accepted[as_index(constraint)] =
          association_.hypothesis().chosen[i] != Association::kNone;
    }
    // Where no loop was rejected, none is suspected; the test would cost as much as all decisions.
    const bool is_contested = std::ranges::count(result_.accepted, false) > 0;
    if (params_.best_first && is_contested && association_.has_contradictory_group()) {
      result_.doubts.emplace_back("a group of accepted loops contradicts the others");
    }
    result_.bridges = odometry_.bridges;
    result_.trials = association_.trials();
  }

  /// Where the errors are larger than stated as a whole, right loops were rejected: the rejected
  /// ones are decided again by gates for these errors. Once only, and not where the map may be
  /// wrong.
  void reconsider_by_variance_factor() {
    const Hypothesis& map = association_.hypothesis();
    const auto rejected = std::ranges::count(map.chosen, Association::kNone);
    const auto factor = variance_factor(map.objective, std::ssize(map.chosen) - rejected);
    if (!factor || *factor <= 1.0 || *factor >= kMisfitDoubtful) return;
    if (association_.raise_noise(*factor)) record({}, association_.reconsider(0));
  }

  const PoseGraph& graph_;
  LazyAssociationParams params_;
  GraphOdometry odometry_;
  LazyAssociation association_;
  std::optional<LoopQueue> queue_;
  std::vector<int> order_;              // in which the loops of `odometry_` were decided
  std::size_t noise_of_ = kBatchFirst;  // accepted loops at the last estimate of their noise
  LazyLoopClosuresResult result_;
};

}  // namespace

LazyLoopClosuresResult associate_loops_lazily(const PoseGraph& graph,
                                              const LazyAssociationParams& params,
                                              const std::function<void(double)>& progress) {
  return FileAssociation(graph, params).run(progress);
}

std::optional<std::string> doubt_of_misfit(const LazyLoopClosuresResult& result, double objective) {
  const auto accepted = std::ranges::count_if(result.constraint_of_loop_closure,
                                              [&](int k) { return result.accepted[as_index(k)]; });
  const auto misfit = variance_factor(objective, accepted);
  if (!misfit || *misfit < kMisfitDoubtful) return std::nullopt;
  return fmt::format("the chi-square of the map is {:.1f} times that of the stated noise", *misfit);
}

OptimizeResult optimize_accepted(PoseGraph& graph, const std::vector<bool>& accepted,
                                 const OptimizeObserver& observer, bool from_poses) {
  const AcceptedConstraints full(graph, accepted);
  PoseGraph weighted{graph.poses, full.constraints};
  OptimizeParams params;
  params.rotation_initialization = !from_poses;
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

OptimizeResult optimize_accepted(PoseGraph& graph, const LazyLoopClosuresResult& result,
                                 const OptimizeObserver& observer) {
  const bool has_start = !result.T_map_node.empty();
  if (has_start) graph.poses = result.T_map_node;
  return optimize_accepted(graph, result.accepted, observer, has_start);
}

}  // namespace adit
