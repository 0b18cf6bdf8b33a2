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
  return a.previously_chosen == Association::kNone ? "likely now that others are undone"
                                                   : "another alternative explains more";
}

}  // namespace

void LazyAssociation::add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information) {
  trial_.reset();
  const int maps = problem_.odometry.maps();
  if (maps == 0) {
    problem_.odometry.add_map({});
    hypothesis_.T_map_local.emplace_back();
    return;
  }
  problem_.chain.push_back({maps - 1, maps, T_previous_local, information});
  problem_.odometry.add_map({T_previous_local, information.inverse()});
  hypothesis_.T_map_local.push_back(hypothesis_.T_map_local.back() * T_previous_local);
}

std::vector<Association> LazyAssociation::decide(std::vector<LoopClosure> loop_closures,
                                                 std::int64_t utime) {
  std::vector<Association> record;
  for (LoopClosure& loop_closure : loop_closures) {
    append(std::move(loop_closure));
    const std::vector<int> before = hypothesis_.chosen;
    decide_one(problem_.loop_closures.back().id);
    record_changes(record, utime, before, before.size() - 1);
  }
  return record;
}

Trial& LazyAssociation::trial() {
  if (!trial_) trial_.emplace(problem_, hypothesis_);
  return *trial_;
}

/// A belief with closures that the problem does not have yet.
struct LazyAssociation::Revision {
  std::vector<LoopClosure> added;
  Hypothesis hypothesis;
};

/// The alternatives that would put a map where it is now, on maps before `first`: they are not
/// asked again when the belief that put it there is given up.
void LazyAssociation::exclude_accepted_alternatives(LoopClosure& loop_closure, int first) const {
  const Pose2& now = hypothesis_.T_map_local[at(loop_closure.newer_map)];
  std::erase_if(loop_closure.alternatives, [&](const LoopClosureAlternative& a) {
    if (a.older_map >= first) return false;
    const Pose2 apart = between(now, hypothesis_.T_map_local[at(a.older_map)] * a.T_older_newer);
    return apart.translation().norm() < kSamePlaceM && std::abs(apart.theta) < kSamePlaceRad;
  });
}

/// Undoes decisions and decides again on the maps since the first of them, by what they have to say
/// in their new places.
LazyAssociation::Revision LazyAssociation::reassociate(const RevisionCandidate& candidate,
                                                       const Evidence& evidence) {
  ++trials_;
  const int first_map = problem_.loop_closures[at(candidate.loop_closures.front())].newer_map;
  const auto closures_before = static_cast<std::ptrdiff_t>(problem_.loop_closures.size());
  const int groups = groups_;
  Trial trial(problem_, trial_->hypothesis(),
              first_affected_map(candidate, candidate.loop_closures.front()));
  trial.revoke(candidate.loop_closures);
  bool found = false;  // where these maps lie now; until then all that is possible is asked
  for (int map = first_map; map < problem_.odometry.maps(); ++map) {
    for (LoopClosure& loop_closure : evidence.loop_closures(map, trial, !found)) {
      exclude_accepted_alternatives(loop_closure, first_map);
      if (loop_closure.alternatives.empty()) continue;
      add_to_problem(std::move(loop_closure));
      trial.grow();
      const LoopClosure& added = problem_.loop_closures.back();
      const bool chosen = choose(trial, added.id);
      found |= chosen && added.alternatives.front().older_map < first_map;
    }
  }
  trial.reoptimize();
  Revision revision{{}, trial.hypothesis()};
  revision.hypothesis.cost = cost(revision.hypothesis);
  const auto first_added = problem_.loop_closures.begin() + closures_before;
  revision.added.assign(std::make_move_iterator(first_added),
                        std::make_move_iterator(problem_.loop_closures.end()));
  problem_.loop_closures.erase(first_added, problem_.loop_closures.end());
  problem_.groups.resize(problem_.loop_closures.size());
  problem_.plausible.resize(problem_.loop_closures.size());
  groups_ = groups;
  return revision;
}

std::vector<Association> LazyAssociation::revise(const Evidence& evidence, std::int64_t utime) {
  const double map_inconsistency = evidence.map_inconsistency(hypothesis_.T_map_local);
  if (map_inconsistency < params_.gate) {
    revision_threshold_ = 0.0;
    return {};
  }
  if (map_inconsistency < revision_threshold_) return {};
  std::optional<Revision> best;
  double gain = 0.0;
  for (const RevisionCandidate& candidate : latest_groups(problem_, trial(), kGroupsUndone)) {
    Revision revision = reassociate(candidate, evidence);
    const auto added = static_cast<double>(revision.added.size());
    const double present = hypothesis_.cost + added * params_.gate + map_inconsistency;
    const double then =
        revision.hypothesis.cost + evidence.map_inconsistency(revision.hypothesis.T_map_local);
    if (present - then <= gain) continue;
    gain = present - then;
    best = std::move(revision);
    if (!params_.best_first) break;
  }
  revision_threshold_ = 2.0 * map_inconsistency;
  if (!best) return {};

  std::vector<Association> record;
  std::vector<int> before = hypothesis_.chosen;
  const std::size_t closures_before = before.size();
  before.resize(best->hypothesis.chosen.size(), Association::kNone);
  for (LoopClosure& loop_closure : best->added) append(std::move(loop_closure));
  set_hypothesis(std::move(best->hypothesis));
  record_changes(record, utime, before, closures_before);
  revision_threshold_ = 0.0;
  return record;
}

LazyAssociation::Checkpoint LazyAssociation::checkpoint() const {
  return {problem_.odometry.maps(), problem_.loop_closures.size(), hypothesis_,
          search_threshold_,        revision_threshold_,           groups_};
}

void LazyAssociation::roll_back(Checkpoint checkpoint) {
  trial_.reset();
  problem_.chain.resize(static_cast<std::size_t>(std::max(0, checkpoint.maps - 1)));
  problem_.odometry.truncate(checkpoint.maps);
  problem_.loop_closures.resize(checkpoint.loop_closures);
  problem_.groups.resize(checkpoint.loop_closures);
  problem_.plausible.resize(checkpoint.loop_closures);
  hypothesis_ = std::move(checkpoint.hypothesis);
  search_threshold_ = std::move(checkpoint.search_threshold);
  revision_threshold_ = checkpoint.revision_threshold;
  groups_ = checkpoint.groups;
}

void LazyAssociation::restore(const std::vector<Association>& associations) {
  for (const Association& a : associations) {
    if (a.loop_closure.id == static_cast<int>(problem_.loop_closures.size()))
      append(a.loop_closure);
    hypothesis_.chosen[at(a.loop_closure.id)] = a.chosen;
  }
  trial_.reset();
  Trial trial(problem_, hypothesis_);
  trial.reoptimize();
  hypothesis_ = trial.hypothesis();
  hypothesis_.cost = cost(hypothesis_);
}

void LazyAssociation::append(LoopClosure loop_closure) {
  add_to_problem(std::move(loop_closure));
  hypothesis_.chosen.push_back(Association::kNone);
  if (trial_) trial_->grow();
}

/// Into the problem alone, of which no belief knows yet.
void LazyAssociation::add_to_problem(LoopClosure loop_closure) {
  const int group = group_of(loop_closure);
  problem_.groups.push_back(group >= 0 ? group : groups_++);
  loop_closure.id = static_cast<int>(problem_.loop_closures.size());
  bool plausible = false;
  for (int a = 0; a < static_cast<int>(loop_closure.alternatives.size()); ++a) {
    plausible |=
        disagreement(problem_.odometry, constraint_of(loop_closure, a)) < kPlausible * params_.gate;
  }
  problem_.plausible.push_back(plausible);
  problem_.loop_closures.push_back(std::move(loop_closure));
}

int LazyAssociation::group_of(const LoopClosure& loop_closure) const {
  const auto odometry = [&](int map) { return problem_.odometry.length_m(map); };
  const auto older = [](const LoopClosure& c) { return c.alternatives.front().older_map; };
  for (std::size_t k = problem_.loop_closures.size(); k-- > 0;) {
    const LoopClosure& other = problem_.loop_closures[k];
    if (odometry(loop_closure.newer_map) - odometry(other.newer_map) > params_.group_gap_m) break;
    if (std::abs(odometry(older(loop_closure)) - odometry(older(other))) <= params_.group_gap_m) {
      return problem_.groups[k];
    }
  }
  return -1;
}

/// What leaving a closure out costs now: more, where its neighbours say that this is the place.
double LazyAssociation::gate(const Trial& trial, int loop_closure) const {
  const int group = problem_.groups[at(loop_closure)];
  for (std::size_t k = 0; k < problem_.groups.size(); ++k) {
    if (problem_.groups[k] == group && trial.chosen(static_cast<int>(k)) != Association::kNone) {
      return params_.gate_supported;
    }
  }
  return params_.gate;
}

double LazyAssociation::cost(const Hypothesis& hypothesis) const {
  double cost = hypothesis.objective;
  for (std::size_t k = 0; k < hypothesis.chosen.size(); ++k) {
    cost += hypothesis.chosen[k] == Association::kNone
                ? params_.gate
                : penalty(problem_.loop_closures[k], hypothesis.chosen[k]);
  }
  return cost;
}

/// Takes the best alternative if it is likely.
bool LazyAssociation::choose(Trial& trial, int loop_closure) const {
  const LoopClosure& c = problem_.loop_closures[at(loop_closure)];
  double least = gate(trial, loop_closure);
  int best = Association::kNone;
  for (int a = 0; a < static_cast<int>(c.alternatives.size()); ++a) {
    const double objective_increase = trial.objective_increase(constraint_of(c, a)) + penalty(c, a);
    if (objective_increase >= least) continue;
    least = objective_increase;
    best = a;
  }
  if (best == Association::kNone) return false;
  trial.accept(loop_closure, best);
  return true;
}

void LazyAssociation::decide_one(int loop_closure) {
  if (choose(trial(), loop_closure)) return;
  if (!problem_.plausible[at(loop_closure)] || !search_is_due(loop_closure)) return;
  if (auto found = search(loop_closure)) set_hypothesis(std::move(*found));
}

/// Goes on from a belief that was worked out while some maps were held.
void LazyAssociation::set_hypothesis(Hypothesis hypothesis) {
  const bool partially_optimized = hypothesis.partially_optimized;
  trial_.emplace(problem_, std::move(hypothesis));
  if (partially_optimized) trial_->reoptimize();
}

/// Makes the trial what is believed, and writes down what changed. `first_new`: the first closure
/// that is decided for the first time.
void LazyAssociation::record_changes(std::vector<Association>& record, std::int64_t utime,
                                     const std::vector<int>& before, std::size_t first_new) {
  hypothesis_ = trial_->hypothesis();
  hypothesis_.cost = cost(hypothesis_);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const bool is_new = k >= first_new;
    if (!is_new && hypothesis_.chosen[k] == before[k]) continue;
    Association a;
    a.utime = utime;
    a.action = is_new ? Association::Action::kProposed : Association::Action::kRevised;
    a.loop_closure = problem_.loop_closures[k];
    a.chosen = hypothesis_.chosen[k];
    a.previously_chosen = before[k];
    a.log_likelihood = -0.5 * hypothesis_.cost;
    a.reason = reason_of(a);
    record.push_back(std::move(a));
  }
}

/// The first contradiction of a group is looked into, then the second, the fourth, and so on: what
/// one more of the same kind could not change before is not asked each time.
bool LazyAssociation::search_is_due(int loop_closure) {
  const int group = problem_.groups[at(loop_closure)];
  int contradictions = 0;
  for (int k = 0; k <= loop_closure; ++k) {
    if (problem_.groups[at(k)] != group || !problem_.plausible[at(k)]) continue;
    contradictions += trial_->chosen(k) == Association::kNone ? 1 : 0;
  }
  int& due = search_threshold_[group];
  if (contradictions < due) return false;
  due = 2 * contradictions;
  return true;
}

/// A belief in which the closure is chosen and that costs less than the present one.
std::optional<Hypothesis> LazyAssociation::search(int loop_closure) {
  Hypothesis present = trial_->hypothesis();
  double least = cost(present);
  const std::vector<RevisionCandidate> order =
      params_.best_first ? revision_candidates(problem_, *trial_, loop_closure, params_.gate, least)
                         : latest_groups(problem_, *trial_, params_.trials_max);
  std::optional<Hypothesis> best;
  int budget = params_.trials_max;
  for (const RevisionCandidate& candidate : order) {
    if (budget-- == 0 || candidate.bound >= least) break;
    auto hypothesis = without(candidate, loop_closure);
    if (!hypothesis || hypothesis->cost >= least) continue;
    least = hypothesis->cost;
    best = std::move(hypothesis);
    if (!params_.best_first) break;
  }
  return best;
}

/// The earliest map that a revision moves: loops begin at their older maps.
int LazyAssociation::first_affected_map(const RevisionCandidate& candidate,
                                        int loop_closure) const {
  int first = problem_.chain.empty() ? 0 : problem_.loop_closures[at(loop_closure)].newer_map;
  const auto include = [&](int k) {
    for (const LoopClosureAlternative& a : problem_.loop_closures[at(k)].alternatives) {
      first = std::min(first, a.older_map);
    }
  };
  include(loop_closure);
  for (const int k : candidate.loop_closures) include(k);
  return first;
}

/// What is believed when some decisions are undone, the closure is taken for true, and whatever was
/// left out since the first of them is decided again. Nothing if it is unlikely even so.
std::optional<Hypothesis> LazyAssociation::without(const RevisionCandidate& candidate,
                                                   int loop_closure) {
  ++trials_;
  Trial trial(problem_, trial_->hypothesis(), first_affected_map(candidate, loop_closure));
  trial.revoke(candidate.loop_closures);
  if (!choose(trial, loop_closure)) return std::nullopt;
  for (int k = candidate.loop_closures.front(); k < loop_closure; ++k) {
    const bool open = trial.chosen(k) == Association::kNone && problem_.plausible[at(k)];
    if (open) choose(trial, k);
  }
  trial.reoptimize();
  Hypothesis hypothesis = trial.hypothesis();
  hypothesis.cost = cost(hypothesis);
  return hypothesis;
}

/// Revokes the chosen closure without which everything else fits best, and the next, as long as
/// that gains more than leaving it out costs.
void LazyAssociation::revoke_misfits(Trial& trial) const {
  while (true) {
    const std::vector<int> chosen = trial.chosen_loop_closures();
    if (chosen.empty()) return;
    const auto without = trial.leave_one_out(
        chosen,
        constraint_of(problem_.loop_closures[at(chosen.front())], trial.chosen(chosen.front())));
    const auto worst = std::max_element(without.begin(), without.end(), [](auto& a, auto& b) {
      return a.objective_decrease < b.objective_decrease;
    });
    const int misfit = chosen[static_cast<std::size_t>(worst - without.begin())];
    if (worst->objective_decrease <= gate(trial, misfit)) return;
    trial.revoke({misfit});
  }
}

std::vector<Association> LazyAssociation::reconsider(std::int64_t utime) {
  std::vector<Association> record;
  Trial& present = trial();
  const std::vector<int> before = hypothesis_.chosen;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> last = present.decisions();
    revoke_misfits(present);
    for (int k = 0; k < static_cast<int>(before.size()); ++k) {
      if (present.chosen(k) == Association::kNone) choose(present, k);
    }
    present.reoptimize();
    if (present.decisions() == last) break;
  }
  record_changes(record, utime, before, before.size());
  return record;
}

}  // namespace adit
