// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/lazy_association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace adit {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A belief with some decisions undone that is yet to be worked out.
struct Branch {
  double bound = 0.0;  // on the cost of all beliefs that come of it
  int order = 0;       // among equals the first
  int first = 0;       // the earliest decision that was undone
  Belief belief;

  friend bool operator>(const Branch& a, const Branch& b) {
    return std::pair(a.bound, a.order) > std::pair(b.bound, b.order);
  }
};

}  // namespace

void LazyAssociation::add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information) {
  trial_.reset();
  const int maps = problem_.maps();
  if (maps == 0) {
    problem_.way_m.push_back(0.0);
    belief_.T_map_local.emplace_back();
    return;
  }
  problem_.chain.push_back({maps - 1, maps, T_previous_local, information});
  problem_.way_m.push_back(problem_.way_m.back() + T_previous_local.translation().norm());
  belief_.T_map_local.push_back(belief_.T_map_local.back() * T_previous_local);
}

int LazyAssociation::group_of(const Closure& closure) const {
  const auto way = [&](int map) { return problem_.way_m[at(map)]; };
  const auto older = [](const Closure& c) { return c.alternatives.front().older_map; };
  for (std::size_t k = problem_.closures.size(); k-- > 0;) {
    const Closure& other = problem_.closures[k];
    if (way(closure.newer_map) - way(other.newer_map) > params_.group_gap_m) break;
    if (std::abs(way(older(closure)) - way(older(other))) <= params_.group_gap_m) {
      return problem_.groups[k];
    }
  }
  return -1;
}

std::vector<Association> LazyAssociation::decide(std::vector<Closure> closures,
                                                 std::int64_t utime) {
  std::vector<Association> record;
  for (Closure& closure : closures) {
    append(std::move(closure));
    decide_one(problem_.closures.back().id, record, utime);
  }
  return record;
}

void LazyAssociation::restore(const std::vector<Association>& associations) {
  for (const Association& a : associations) {
    if (a.closure.id == static_cast<int>(problem_.closures.size())) append(a.closure);
    belief_.chosen[at(a.closure.id)] = a.chosen;
  }
  Trial trial(problem_, belief_);
  trial.settle();
  belief_ = trial.belief();
  belief_.cost = cost(belief_);
}

void LazyAssociation::append(Closure closure) {
  const int group = group_of(closure);
  problem_.groups.push_back(group >= 0 ? group : groups_++);
  closure.id = static_cast<int>(problem_.closures.size());
  problem_.closures.push_back(std::move(closure));
  plausible_.push_back(fits_the_way(problem_.closures.back().id));
  belief_.chosen.push_back(Association::kNone);
  if (trial_) trial_->grow();
}

double LazyAssociation::alternative_cost(int closure, int alternative) const {
  const auto& alternatives = problem_.closures[at(closure)].alternatives;
  return 2.0 * (alternatives.front().log_likelihood - alternatives[at(alternative)].log_likelihood);
}

double LazyAssociation::gate(const std::vector<int>& chosen, int closure) const {
  const int group = problem_.groups[at(closure)];
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (problem_.groups[k] == group && chosen[k] != Association::kNone) {
      return params_.gate_supported;
    }
  }
  return params_.gate;
}

double LazyAssociation::cost(const Belief& belief) const {
  double cost = belief.objective;
  for (std::size_t k = 0; k < belief.chosen.size(); ++k) {
    const int closure = static_cast<int>(k);
    cost += belief.chosen[k] == Association::kNone ? params_.gate
                                                   : alternative_cost(closure, belief.chosen[k]);
  }
  return cost;
}

std::optional<int> LazyAssociation::cheapest(Trial& trial, int closure, double& cost) const {
  const Closure& c = problem_.closures[at(closure)];
  std::optional<int> best;
  for (int a = 0; a < static_cast<int>(c.alternatives.size()); ++a) {
    const double total = trial.price(constraint_of(c, a)) + alternative_cost(closure, a);
    if (best && total >= cost) continue;
    best = a;
    cost = total;
  }
  return best;
}

/// Takes the best alternative if it is likely.
bool LazyAssociation::choose(Trial& trial, int closure) const {
  double cost = 0.0;
  const auto best = cheapest(trial, closure, cost);
  if (!best || cost >= gate(trial.decisions(), closure)) return false;
  trial.take(closure, *best);
  return true;
}

void LazyAssociation::decide_one(int closure, std::vector<Association>& record,
                                 std::int64_t utime) {
  if (!trial_) trial_.emplace(problem_, belief_);
  const std::vector<int> before = trial_->decisions();
  if (!choose(*trial_, closure) && plausible_[at(closure)] && search_is_due(closure)) {
    Belief found = search(closure);
    if (found.chosen != before) trial_.emplace(problem_, std::move(found));
  }
  belief_ = trial_->belief();
  belief_.cost = cost(belief_);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const bool is_new = static_cast<int>(k) == closure;
    if (!is_new && belief_.chosen[k] == before[k]) continue;
    Association a;
    a.utime = utime;
    a.action = is_new ? Association::Action::kProposed : Association::Action::kRevised;
    a.closure = problem_.closures[k];
    a.chosen = belief_.chosen[k];
    a.chosen_before = before[k];
    a.log_likelihood = -0.5 * belief_.cost;
    record.push_back(std::move(a));
  }
}

/// The first contradiction of a group is looked into, then the second, the fourth, and so on: what
/// one more of the same kind could not change before is not asked each time.
bool LazyAssociation::search_is_due(int closure) {
  const int group = problem_.groups[at(closure)];
  int contradictions = 0;
  for (int k = 0; k <= closure; ++k) {
    if (problem_.groups[at(k)] != group || !plausible_[at(k)]) continue;
    contradictions += trial_->chosen(k) == Association::kNone ? 1 : 0;
  }
  int& due = search_due_[group];
  if (contradictions < due) return false;
  due = 2 * contradictions;
  return true;
}

/// Whether the closure can be right at all, given the way alone: what the chain of displacements
/// between the two maps says.
bool LazyAssociation::fits_the_way(int closure) const {
  const Closure& c = problem_.closures[at(closure)];
  return std::any_of(c.alternatives.begin(), c.alternatives.end(), [&](const auto& a) {
    Pose2 T_older_newer;
    Eigen::Matrix3d covariance = a.information.inverse();
    for (int k = a.older_map; k < c.newer_map; ++k) {
      const PoseConstraint& step = problem_.chain[at(k)];
      const Eigen::Matrix3d Ad = adjoint(step.T_from_to.inverse());
      T_older_newer = T_older_newer * step.T_from_to;
      covariance = Ad * covariance * Ad.transpose() + step.information.inverse();
    }
    const Eigen::Vector3d e = between(a.T_older_newer, T_older_newer).vector();
    return e.dot(covariance.ldlt().solve(e)) < 1.5 * params_.gate;
  });
}

/// Chosen closures that could be to blame if this one is right: single ones and groups, the most
/// suspect first. A group is left out if to give it up would cost more than what could be gained.
std::vector<std::vector<int>> LazyAssociation::suspects(Trial& trial, int closure) const {
  std::vector<int> chosen;
  for (int k = 0; k < static_cast<int>(problem_.closures.size()); ++k) {
    if (trial.chosen(k) != Association::kNone) chosen.push_back(k);
  }
  const auto without =
      trial.without_each(chosen, constraint_of(problem_.closures[at(closure)], 0));
  struct Suspect {
    double price = std::numeric_limits<double>::max();
    double fall = 0.0;
    std::vector<int> closures;
  };
  std::vector<Suspect> all;
  std::map<int, Suspect> groups;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (without[i].rise < params_.gate_supported) {
      all.push_back({without[i].rise, without[i].objective_fall, {chosen[i]}});
    }
    Suspect& group = groups[problem_.groups[at(chosen[i])]];
    group.price = std::min(group.price, without[i].rise);
    group.fall += without[i].objective_fall;
    group.closures.push_back(chosen[i]);
  }
  for (const auto& [id, group] : groups) {
    if (group.closures.size() > 1) all.push_back(group);
  }
  std::erase_if(all, [&](const Suspect& s) {
    double given_up = -s.fall;
    for (const int k : s.closures) {
      if (problem_.closures[at(k)].alternatives.size() == 1) given_up += params_.gate;
    }
    for (int k = s.closures.front(); k <= closure; ++k) {
      if (trial.chosen(k) == Association::kNone && plausible_[at(k)]) given_up -= params_.gate;
    }
    return given_up > 0.0;
  });
  std::stable_sort(all.begin(), all.end(), [&](const Suspect& a, const Suspect& b) {
    return params_.best_first ? a.price < b.price : a.closures.back() > b.closures.back();
  });
  std::vector<std::vector<int>> found;
  for (Suspect& suspect : all) {
    if (static_cast<int>(found.size()) == params_.suspects_max) break;
    found.push_back(std::move(suspect.closures));
  }
  return found;
}

Belief LazyAssociation::search(int closure) {
  Belief best = trial_->belief();
  best.cost = cost(best);
  std::priority_queue<Branch, std::vector<Branch>, std::greater<>> open;
  int order = 0;
  int budget = params_.trials_max;
  const auto branch = [&](Trial& from, int first) {
    for (const std::vector<int>& group : suspects(from, closure)) {
      if (--budget < 0) return;
      Trial undone(problem_, from.belief());
      undone.revoke(group);
      ++trials_;
      Branch next{0.0, order++, std::min(first, group.front()), undone.belief()};
      next.bound = bound(next.belief, next.first, group);
      if (next.bound < best.cost) open.push(std::move(next));
    }
  };
  branch(*trial_, closure);
  while (!open.empty() && open.top().bound < best.cost) {
    const Branch next = open.top();
    open.pop();
    Trial trial(problem_, next.belief);
    if (!choose(trial, closure)) {
      if (budget > 0) branch(trial, next.first);
      continue;
    }
    ++trials_;
    for (int k = next.first; k < closure; ++k) {
      if (trial.chosen(k) == Association::kNone && plausible_[at(k)]) choose(trial, k);
    }
    trial.settle();
    Belief belief = trial.belief();
    belief.cost = cost(belief);
    if (belief.cost < best.cost) best = std::move(belief);
  }
  return best;
}

/// A lower bound on the cost of every belief that leaves `undone` as it is and the decisions before
/// `first` too: the objective cannot fall when constraints are added, and no closure that may be
/// decided again costs less than nothing.
double LazyAssociation::bound(const Belief& belief, int first,
                              const std::vector<int>& undone) const {
  double bound = cost(belief);
  for (int k = first; k < static_cast<int>(belief.chosen.size()); ++k) {
    if (belief.chosen[at(k)] != Association::kNone) continue;
    const bool stays = std::find(undone.begin(), undone.end(), k) != undone.end() &&
                       problem_.closures[at(k)].alternatives.size() == 1;
    if (!stays && plausible_[at(k)]) bound -= params_.gate;
  }
  return bound;
}

std::vector<Association> LazyAssociation::reconsider(std::int64_t utime) {
  std::vector<Association> record;
  for (int k = 0; k < static_cast<int>(problem_.closures.size()); ++k) {
    if (belief_.chosen[at(k)] == Association::kNone) decide_one(k, record, utime);
  }
  return record;
}

}  // namespace adit
