// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/lazy_association.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/LU>

namespace adit {
namespace {

constexpr double kSamePlaceM = 2.0;  // alternatives nearer than this say the same
constexpr double kSamePlaceRad = 0.2;
constexpr int kGroupsUndone = 3;    // at most, for a map that contradicts what it lies on
constexpr int kRounds = 10;         // of letting go and taking in, which end by themselves
constexpr double kPlausible = 1.5;  // gates: the way is only known to first order

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string reason_of(const Association& a) {
  const bool now = a.chosen != Association::kNone;
  if (a.action == Association::Action::kProposed) {
    return now ? "the most likely alternative" : "no alternative is likely given the map";
  }
  if (!now) return "contradicted by later measurements";
  return a.chosen_before == Association::kNone ? "likely now that others are undone"
                                               : "another alternative explains more";
}

}  // namespace

void LazyAssociation::add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information) {
  trial_.reset();
  const int maps = problem_.way.maps();
  if (maps == 0) {
    problem_.way.add_map({});
    belief_.T_map_local.emplace_back();
    return;
  }
  problem_.chain.push_back({maps - 1, maps, T_previous_local, information});
  problem_.way.add_map({T_previous_local, information.inverse()});
  belief_.T_map_local.push_back(belief_.T_map_local.back() * T_previous_local);
}

std::vector<Association> LazyAssociation::decide(std::vector<Closure> closures,
                                                 std::int64_t utime) {
  std::vector<Association> record;
  for (Closure& closure : closures) {
    append(std::move(closure));
    const std::vector<int> before = belief_.chosen;
    decide_one(problem_.closures.back().id);
    adopt(record, utime, before, before.size() - 1);
  }
  return record;
}

Trial& LazyAssociation::trial() {
  if (!trial_) trial_.emplace(problem_, belief_);
  return *trial_;
}

/// A belief with closures that the problem does not have yet.
struct LazyAssociation::Revision {
  std::vector<Closure> added;
  Belief belief;
};

/// The alternatives that would put a map where it is now, on maps before `first`: they are not
/// asked again when the belief that put it there is given up.
void LazyAssociation::leave_out_what_is_believed(Closure& closure, int first) const {
  const Pose2& now = belief_.T_map_local[at(closure.newer_map)];
  std::erase_if(closure.alternatives, [&](const ClosureAlternative& a) {
    if (a.older_map >= first) return false;
    const Pose2 apart = between(now, belief_.T_map_local[at(a.older_map)] * a.T_older_newer);
    return apart.translation().norm() < kSamePlaceM && std::abs(apart.theta) < kSamePlaceRad;
  });
}

/// Undoes decisions and decides again on the maps since the first of them, by what they have to say
/// in their new places.
LazyAssociation::Revision LazyAssociation::associate_afresh(const Suspects& undone,
                                                            const Evidence& evidence) {
  ++trials_;
  const int first_map = problem_.closures[at(undone.closures.front())].newer_map;
  const auto known = static_cast<std::ptrdiff_t>(problem_.closures.size());
  const int groups = groups_;
  Trial trial(problem_, trial_->belief(), first_concerned(undone, undone.closures.front()));
  trial.revoke(undone.closures);
  bool found = false;  // where these maps lie now; until then all that is possible is asked
  for (int map = first_map; map < problem_.way.maps(); ++map) {
    for (Closure& closure : evidence.closures(map, trial, !found)) {
      leave_out_what_is_believed(closure, first_map);
      if (closure.alternatives.empty()) continue;
      enter(std::move(closure));
      trial.grow();
      const Closure& added = problem_.closures.back();
      const bool chosen = choose(trial, added.id);
      found |= chosen && added.alternatives.front().older_map < first_map;
    }
  }
  trial.settle();
  Revision revision{{}, trial.belief()};
  revision.belief.cost = cost(revision.belief);
  const auto first_added = problem_.closures.begin() + known;
  revision.added.assign(std::make_move_iterator(first_added),
                        std::make_move_iterator(problem_.closures.end()));
  problem_.closures.erase(first_added, problem_.closures.end());
  problem_.groups.resize(problem_.closures.size());
  problem_.plausible.resize(problem_.closures.size());
  groups_ = groups;
  return revision;
}

std::vector<Association> LazyAssociation::revise(const Evidence& evidence, std::int64_t utime) {
  const double surprise = evidence.surprise(belief_.T_map_local);
  if (surprise < params_.gate) {
    surprise_due_ = 0.0;
    return {};
  }
  if (surprise < surprise_due_) return {};
  std::optional<Revision> best;
  double gain = 0.0;
  for (const Suspects& undone : latest_groups(problem_, trial(), kGroupsUndone)) {
    Revision revision = associate_afresh(undone, evidence);
    const auto added = static_cast<double>(revision.added.size());
    const double present = belief_.cost + added * params_.gate + surprise;
    const double then = revision.belief.cost + evidence.surprise(revision.belief.T_map_local);
    if (present - then <= gain) continue;
    gain = present - then;
    best = std::move(revision);
    if (!params_.best_first) break;
  }
  surprise_due_ = 2.0 * surprise;
  if (!best) return {};

  std::vector<Association> record;
  std::vector<int> before = belief_.chosen;
  const std::size_t known = before.size();
  before.resize(best->belief.chosen.size(), Association::kNone);
  for (Closure& closure : best->added) append(std::move(closure));
  believe(std::move(best->belief));
  adopt(record, utime, before, known);
  surprise_due_ = 0.0;
  return record;
}

LazyAssociation::Mark LazyAssociation::mark() const {
  return {
      problem_.way.maps(), problem_.closures.size(), belief_, search_due_, surprise_due_, groups_};
}

void LazyAssociation::go_back_to(Mark mark) {
  trial_.reset();
  problem_.chain.resize(static_cast<std::size_t>(std::max(0, mark.maps - 1)));
  problem_.way.shorten_to(mark.maps);
  problem_.closures.resize(mark.closures);
  problem_.groups.resize(mark.closures);
  problem_.plausible.resize(mark.closures);
  belief_ = std::move(mark.belief);
  search_due_ = std::move(mark.search_due);
  surprise_due_ = mark.surprise_due;
  groups_ = mark.groups;
}

void LazyAssociation::restore(const std::vector<Association>& associations) {
  for (const Association& a : associations) {
    if (a.closure.id == static_cast<int>(problem_.closures.size())) append(a.closure);
    belief_.chosen[at(a.closure.id)] = a.chosen;
  }
  trial_.reset();
  Trial trial(problem_, belief_);
  trial.settle();
  belief_ = trial.belief();
  belief_.cost = cost(belief_);
}

void LazyAssociation::append(Closure closure) {
  enter(std::move(closure));
  belief_.chosen.push_back(Association::kNone);
  if (trial_) trial_->grow();
}

/// Into the problem alone, of which no belief knows yet.
void LazyAssociation::enter(Closure closure) {
  const int group = group_of(closure);
  problem_.groups.push_back(group >= 0 ? group : groups_++);
  closure.id = static_cast<int>(problem_.closures.size());
  bool plausible = false;
  for (int a = 0; a < static_cast<int>(closure.alternatives.size()); ++a) {
    plausible |= disagreement(problem_.way, constraint_of(closure, a)) < kPlausible * params_.gate;
  }
  problem_.plausible.push_back(plausible);
  problem_.closures.push_back(std::move(closure));
}

int LazyAssociation::group_of(const Closure& closure) const {
  const auto way = [&](int map) { return problem_.way.length_m(map); };
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

/// What leaving a closure out costs now: more, where its neighbours say that this is the place.
double LazyAssociation::gate(const Trial& trial, int closure) const {
  const int group = problem_.groups[at(closure)];
  for (std::size_t k = 0; k < problem_.groups.size(); ++k) {
    if (problem_.groups[k] == group && trial.chosen(static_cast<int>(k)) != Association::kNone) {
      return params_.gate_supported;
    }
  }
  return params_.gate;
}

double LazyAssociation::cost(const Belief& belief) const {
  double cost = belief.objective;
  for (std::size_t k = 0; k < belief.chosen.size(); ++k) {
    cost += belief.chosen[k] == Association::kNone
                ? params_.gate
                : penalty(problem_.closures[k], belief.chosen[k]);
  }
  return cost;
}

/// Takes the best alternative if it is likely.
bool LazyAssociation::choose(Trial& trial, int closure) const {
  const Closure& c = problem_.closures[at(closure)];
  double least = gate(trial, closure);
  int best = Association::kNone;
  for (int a = 0; a < static_cast<int>(c.alternatives.size()); ++a) {
    const double price = trial.price(constraint_of(c, a)) + penalty(c, a);
    if (price >= least) continue;
    least = price;
    best = a;
  }
  if (best == Association::kNone) return false;
  trial.take(closure, best);
  return true;
}

void LazyAssociation::decide_one(int closure) {
  if (choose(trial(), closure)) return;
  if (!problem_.plausible[at(closure)] || !search_is_due(closure)) return;
  if (auto found = search(closure)) believe(std::move(*found));
}

/// Goes on from a belief that was worked out while some maps were held.
void LazyAssociation::believe(Belief belief) {
  const bool held = belief.held;
  trial_.emplace(problem_, std::move(belief));
  if (held) trial_->settle();
}

/// Makes the trial what is believed, and writes down what changed. `first_new`: the first closure
/// that is decided for the first time.
void LazyAssociation::adopt(std::vector<Association>& record, std::int64_t utime,
                            const std::vector<int>& before, std::size_t first_new) {
  belief_ = trial_->belief();
  belief_.cost = cost(belief_);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const bool is_new = k >= first_new;
    if (!is_new && belief_.chosen[k] == before[k]) continue;
    Association a;
    a.utime = utime;
    a.action = is_new ? Association::Action::kProposed : Association::Action::kRevised;
    a.closure = problem_.closures[k];
    a.chosen = belief_.chosen[k];
    a.chosen_before = before[k];
    a.log_likelihood = -0.5 * belief_.cost;
    a.reason = reason_of(a);
    record.push_back(std::move(a));
  }
}

/// The first contradiction of a group is looked into, then the second, the fourth, and so on: what
/// one more of the same kind could not change before is not asked each time.
bool LazyAssociation::search_is_due(int closure) {
  const int group = problem_.groups[at(closure)];
  int contradictions = 0;
  for (int k = 0; k <= closure; ++k) {
    if (problem_.groups[at(k)] != group || !problem_.plausible[at(k)]) continue;
    contradictions += trial_->chosen(k) == Association::kNone ? 1 : 0;
  }
  int& due = search_due_[group];
  if (contradictions < due) return false;
  due = 2 * contradictions;
  return true;
}

/// A belief in which the closure is chosen and that costs less than the present one.
std::optional<Belief> LazyAssociation::search(int closure) {
  Belief present = trial_->belief();
  double least = cost(present);
  const std::vector<Suspects> order =
      params_.best_first ? suspects(problem_, *trial_, closure, params_.gate, least)
                         : latest_groups(problem_, *trial_, params_.trials_max);
  std::optional<Belief> best;
  int budget = params_.trials_max;
  for (const Suspects& undone : order) {
    if (budget-- == 0 || undone.bound >= least) break;
    auto belief = without(undone, closure);
    if (!belief || belief->cost >= least) continue;
    least = belief->cost;
    best = std::move(belief);
    if (!params_.best_first) break;
  }
  return best;
}

/// The earliest map that a revision moves: loops begin at their older maps.
int LazyAssociation::first_concerned(const Suspects& undone, int closure) const {
  int first = problem_.chain.empty() ? 0 : problem_.closures[at(closure)].newer_map;
  const auto include = [&](int k) {
    for (const ClosureAlternative& a : problem_.closures[at(k)].alternatives) {
      first = std::min(first, a.older_map);
    }
  };
  include(closure);
  for (const int k : undone.closures) include(k);
  return first;
}

/// What is believed when some decisions are undone, the closure is taken for true, and whatever was
/// left out since the first of them is decided again. Nothing if it is unlikely even so.
std::optional<Belief> LazyAssociation::without(const Suspects& undone, int closure) {
  ++trials_;
  Trial trial(problem_, trial_->belief(), first_concerned(undone, closure));
  trial.revoke(undone.closures);
  if (!choose(trial, closure)) return std::nullopt;
  for (int k = undone.closures.front(); k < closure; ++k) {
    const bool open = trial.chosen(k) == Association::kNone && problem_.plausible[at(k)];
    if (open) choose(trial, k);
  }
  trial.settle();
  Belief belief = trial.belief();
  belief.cost = cost(belief);
  return belief;
}

/// Revokes the chosen closure without which everything else fits best, and the next, as long as
/// that gains more than leaving it out costs.
void LazyAssociation::let_go_of_misfits(Trial& trial) const {
  while (true) {
    const std::vector<int> chosen = trial.chosen_closures();
    if (chosen.empty()) return;
    const auto without = trial.without_each(
        chosen, constraint_of(problem_.closures[at(chosen.front())], trial.chosen(chosen.front())));
    const auto worst = std::max_element(without.begin(), without.end(), [](auto& a, auto& b) {
      return a.objective_fall < b.objective_fall;
    });
    const int misfit = chosen[static_cast<std::size_t>(worst - without.begin())];
    if (worst->objective_fall <= gate(trial, misfit)) return;
    trial.revoke({misfit});
  }
}

std::vector<Association> LazyAssociation::reconsider(std::int64_t utime) {
  std::vector<Association> record;
  Trial& present = trial();
  const std::vector<int> before = belief_.chosen;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> last = present.decisions();
    let_go_of_misfits(present);
    for (int k = 0; k < static_cast<int>(before.size()); ++k) {
      if (present.chosen(k) == Association::kNone) choose(present, k);
    }
    present.settle();
    if (present.decisions() == last) break;
  }
  adopt(record, utime, before, before.size());
  return record;
}

}  // namespace adit
