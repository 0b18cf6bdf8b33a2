// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/suspects.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace adit {
namespace {

constexpr std::size_t kSingles = 3;  // that are put to the test

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A part of the way, by its first and last map.
struct Stretch {
  int from = 0;
  int to = 0;
};

bool overlap(const Stretch& a, const Stretch& b) { return a.from < b.to && b.from < a.to; }

Stretch loop_of(const PoseConstraint& c) {
  return {std::min(c.from, c.to), std::max(c.from, c.to)};
}

/// What hangs together with `asked` by loops that share a part of the way. Whatever is decided
/// elsewhere has no bearing on it: there the way alone leads on.
Stretch hanging_together(std::vector<Stretch> loops, const Stretch& asked) {
  loops.push_back(asked);
  std::sort(loops.begin(), loops.end(),
            [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  Stretch whole = loops.front();
  for (const Stretch& loop : loops) {
    if (loop.from < whole.to) {
      whole.to = std::max(whole.to, loop.to);
    } else if (overlap(whole, asked)) {
      break;
    } else {
      whole = loop;
    }
  }
  return whole;
}

class Search {
 public:
  Search(const AssociationProblem& problem, Trial& trial, int closure, double gate, double cost)
      : problem_(problem), trial_(trial), closure_(closure), gate_(gate), cost_(cost) {
    find_concerned();
    find_allies();
  }

  std::vector<Suspects> run() {
    add(contradicting());
    const auto without = trial_.without_each(chosen_, asked());
    std::vector<std::pair<double, int>> singles;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      fall_[chosen_[i]] = without[i].objective_fall;
      singles.emplace_back(without[i].rise, chosen_[i]);
    }
    std::sort(singles.begin(), singles.end());
    if (singles.size() > kSingles) singles.resize(kSingles);
    for (const auto& [rise, k] : singles) {
      if (rise < gate_) add({k});
      add(group_of(k));
    }
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Suspects& a, const Suspects& b) { return a.bound < b.bound; });
    return std::move(found_);
  }

 private:
  [[nodiscard]] PoseConstraint asked() const {
    return constraint_of(problem_.closures[at(closure_)], 0);
  }
  [[nodiscard]] PoseConstraint in_force(int k) const {
    return constraint_of(problem_.closures[at(k)], trial_.chosen(k));
  }
  [[nodiscard]] bool agree(const PoseConstraint& a, const PoseConstraint& b) const {
    return disagreement(problem_.way, a, b) < gate_;
  }

  void find_concerned() {
    chosen_ = trial_.chosen_closures();
    std::vector<Stretch> loops;
    for (const int k : chosen_) loops.push_back(loop_of(in_force(k)));
    concerned_ = hanging_together(std::move(loops), loop_of(asked()));
    std::erase_if(chosen_, [&](int k) { return !overlap(loop_of(in_force(k)), concerned_); });
  }

  /// Left out as well, and in agreement with the closure in question.
  void find_allies() {
    for (int k = 0; k < closure_; ++k) {
      if (trial_.chosen(k) != Association::kNone || !problem_.plausible[at(k)]) continue;
      const PoseConstraint constraint = constraint_of(problem_.closures[at(k)], 0);
      const bool near = overlap(loop_of(constraint), concerned_);
      if (near && agree(constraint, asked())) allies_.push_back(constraint);
    }
  }

  [[nodiscard]] std::vector<int> contradicting() const {
    std::vector<int> found;
    for (const int k : chosen_) {
      if (!agree(in_force(k), asked())) found.push_back(k);
    }
    return found;
  }

  [[nodiscard]] std::vector<int> group_of(int closure) const {
    std::vector<int> found;
    for (const int k : chosen_) {
      if (problem_.groups[at(k)] == problem_.groups[at(closure)]) found.push_back(k);
    }
    return found;
  }

  void add(std::vector<int> closures) {
    if (closures.empty() || !seen_.insert(closures).second) return;
    double bound = cost_ - gate_;  // the closure itself is no longer left out
    for (const int k : closures) {
      const bool has_others = problem_.closures[at(k)].alternatives.size() > 1;
      if (!has_others) bound += gate_;
      bound -= fall_.contains(k) ? fall_.at(k) : 0.0;
    }
    for (const PoseConstraint& ally : allies_) {
      const bool kept_out = std::any_of(closures.begin(), closures.end(),
                                        [&](int k) { return !agree(ally, in_force(k)); });
      if (kept_out) bound -= gate_;
    }
    if (bound < cost_) found_.push_back({std::move(closures), bound});
  }

  const AssociationProblem& problem_;
  Trial& trial_;
  int closure_;
  double gate_;
  double cost_;
  Stretch concerned_;
  std::vector<int> chosen_;  // and concerned
  std::vector<PoseConstraint> allies_;
  std::map<int, double> fall_;  // of the objective, if a closure alone is undone
  std::set<std::vector<int>> seen_;
  std::vector<Suspects> found_;
};

}  // namespace

std::vector<Suspects> suspects(const AssociationProblem& problem, Trial& trial, int closure,
                               double gate, double cost) {
  return Search(problem, trial, closure, gate, cost).run();
}

std::vector<Suspects> latest_groups(const AssociationProblem& problem, const Trial& trial,
                                    int most) {
  const std::vector<int> chosen = trial.chosen_closures();
  const auto group = [&](int k) { return problem.groups[at(k)]; };
  std::vector<Suspects> found;
  std::set<int> groups;
  for (auto latest = chosen.rbegin(); latest != chosen.rend(); ++latest) {
    if (!groups.insert(group(*latest)).second) continue;
    if (static_cast<int>(found.size()) == most) break;
    Suspects next;
    std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(next.closures),
                 [&](int k) { return groups.contains(group(k)); });
    found.push_back(std::move(next));
  }
  return found;
}

}  // namespace adit
