// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/revision_candidates.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace adit {
namespace {

constexpr std::size_t kSinglesMax = 3;   // single loop closures tried
constexpr std::size_t kCoupledMax = 40;  // loop closures of which the influence is computed
constexpr std::size_t kGroupsMax = 3;    // contradicted groups that a search may revoke

/// An interval of the chain, by its first and last map.
struct ChainInterval {
  int from = 0;
  int to = 0;
};

bool overlap(const ChainInterval& a, const ChainInterval& b) {
  return a.from < b.to && b.from < a.to;
}

ChainInterval loop_of(const PoseConstraint& c) {
  return {std::min(c.from, c.to), std::max(c.from, c.to)};
}

/// The interval connected with `query` by loops (and bridges) that overlap in the chain. Decisions
/// elsewhere have no influence on it: only the odometry links the intervals.
ChainInterval connected_interval(std::vector<ChainInterval> loops, const ChainInterval& query) {
  loops.push_back(query);
  std::sort(loops.begin(), loops.end(),
            [](const ChainInterval& a, const ChainInterval& b) { return a.from < b.from; });
  ChainInterval component = loops.front();
  for (const ChainInterval& loop : loops) {
    if (loop.from < component.to) {
      component.to = std::max(component.to, loop.to);
    } else if (overlap(component, query)) {
      break;
    } else {
      component = loop;
    }
  }
  return component;
}

class RevisionSearch {
 public:
  RevisionSearch(const AssociationProblem& problem, Trial& trial, int loop_closure, double gate,
                 double cost)
      : problem_(problem), trial_(trial), loop_closure_(loop_closure), gate_(gate), cost_(cost) {
    area_m2_ = problem.odometry.area_m2();
    find_affected();
    find_supporting();
  }

  std::vector<RevisionCandidate> run() {
    const std::vector<int> contradicting = contradicting_loop_closures();
    if (is_hopeless(contradicting)) return {};
    add(contradicting);
    const std::vector<int> coupled = trial_.most_coupled(chosen_, query(), kCoupledMax);
    const auto without = trial_.leave_one_out(coupled, query());
    std::vector<std::pair<double, int>> singles;
    for (std::size_t i = 0; i < coupled.size(); ++i) {
      decrease_[coupled[i]] = without[i].objective_decrease;
      singles.emplace_back(without[i].increase, coupled[i]);
    }
    std::sort(singles.begin(), singles.end());
    if (singles.size() > kSinglesMax) singles.resize(kSinglesMax);
    for (const auto& [increase, k] : singles) {
      if (increase < gate_) add({k}, increase);
      add(group_of(k));
    }
    std::stable_sort(
        candidates_.begin(), candidates_.end(),
        [](const RevisionCandidate& a, const RevisionCandidate& b) { return a.bound < b.bound; });
    return std::move(candidates_);
  }

 private:
  [[nodiscard]] PoseConstraint query() const {
    return constraint_of(problem_.loop_closures[as_index(loop_closure_)], 0);
  }
  [[nodiscard]] PoseConstraint in_force(int k) const {
    return constraint_of(problem_.loop_closures[as_index(k)], trial_.chosen(k));
  }
  [[nodiscard]] bool agree(const PoseConstraint& a, const PoseConstraint& b) const {
    return cycle_residual(problem_.odometry, a, b).disagreement < gate_;
  }
  /// Whether two agree, and would hardly do so by chance.
  [[nodiscard]] bool support(const PoseConstraint& a, const PoseConstraint& b) const {
    const CycleResidual cycle = cycle_residual(problem_.odometry, a, b);
    return cycle.disagreement < gate_ &&
           chance_of_fit(cycle.covariance, gate_, area_m2_) < kChanceMax;
  }

  void find_affected() {
    chosen_ = trial_.chosen_loop_closures();
    std::vector<ChainInterval> loops;
    for (const int k : chosen_) loops.push_back(loop_of(in_force(k)));
    for (const PoseConstraint& bridge : problem_.bridges) loops.push_back(loop_of(bridge));
    affected_ = connected_interval(std::move(loops), loop_of(query()));
    std::erase_if(chosen_, [&](int k) { return !overlap(loop_of(in_force(k)), affected_); });
  }

  /// Finds the rejected loop closures that agree with the one in question.
  void find_supporting() {
    for (int k = 0; k < loop_closure_; ++k) {
      if (trial_.chosen(k) != Association::kNone || !problem_.plausible[as_index(k)]) continue;
      const PoseConstraint constraint = constraint_of(problem_.loop_closures[as_index(k)], 0);
      const bool near = overlap(loop_of(constraint), affected_);
      if (near && support(constraint, query())) supporting_.push_back(constraint);
    }
  }

  [[nodiscard]] std::vector<int> contradicting_loop_closures() const {
    std::vector<int> found;
    for (const int k : chosen_) {
      if (!agree(in_force(k), query())) found.push_back(k);
    }
    return found;
  }

  /// Whether a search cannot pay: the loop closure contradicts so many of so many groups that
  /// rejecting them costs more than all that agrees with it would gain. It is then wrong at random.
  [[nodiscard]] bool is_hopeless(const std::vector<int>& contradicting) const {
    std::set<int> groups;
    for (const int k : contradicting) groups.insert(problem_.groups[as_index(k)]);
    return groups.size() > kGroupsMax &&
           contradicting.size() > 2 * (supporting_.size() + kGroupsMax);
  }

  [[nodiscard]] std::vector<int> group_of(int loop_closure) const {
    std::vector<int> found;
    for (const int k : chosen_) {
      if (problem_.groups[as_index(k)] == problem_.groups[as_index(loop_closure)])
        found.push_back(k);
    }
    return found;
  }

  /// `increase`: of the objective by the loop closure itself, at least.
  void add(std::vector<int> loop_closures, double increase = 0.0) {
    if (loop_closures.empty() || !tried_.insert(loop_closures).second) return;
    double bound = cost_ - gate_ + increase;  // the loop closure itself is no longer rejected
    for (const int k : loop_closures) {
      const bool has_others = problem_.loop_closures[as_index(k)].alternatives.size() > 1;
      if (!has_others) bound += gate_;
      bound -= decrease_.contains(k) ? decrease_.at(k) : 0.0;
    }
    for (const PoseConstraint& supporting : supporting_) {
      const bool contradicted = std::any_of(loop_closures.begin(), loop_closures.end(),
                                            [&](int k) { return !agree(supporting, in_force(k)); });
      if (contradicted) bound -= gate_;
    }
    if (bound < cost_) candidates_.push_back({std::move(loop_closures), bound});
  }

  const AssociationProblem& problem_;
  Trial& trial_;
  int loop_closure_;
  double gate_;
  double cost_;
  double area_m2_ = 0.0;  // of the map
  ChainInterval affected_;
  std::vector<int> chosen_;  // chosen and in the affected interval
  std::vector<PoseConstraint> supporting_;
  std::map<int, double> decrease_;  // of the objective, if one loop closure is revoked
  std::set<std::vector<int>> tried_;
  std::vector<RevisionCandidate> candidates_;
};

}  // namespace

std::vector<RevisionCandidate> revision_candidates(const AssociationProblem& problem, Trial& trial,
                                                   int loop_closure, double gate, double cost) {
  return RevisionSearch(problem, trial, loop_closure, gate, cost).run();
}

std::vector<RevisionCandidate> latest_groups(const AssociationProblem& problem, const Trial& trial,
                                             int most) {
  const std::vector<int> chosen = trial.chosen_loop_closures();
  const auto group = [&](int k) { return problem.groups[as_index(k)]; };
  std::vector<RevisionCandidate> found;
  std::set<int> groups;
  for (auto latest = chosen.rbegin(); latest != chosen.rend(); ++latest) {
    if (!groups.insert(group(*latest)).second) continue;
    if (static_cast<int>(found.size()) == most) break;
    RevisionCandidate next;
    std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(next.loop_closures),
                 [&](int k) { return groups.contains(group(k)); });
    found.push_back(std::move(next));
  }
  return found;
}

}  // namespace adit
