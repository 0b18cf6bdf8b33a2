// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/lazy_association.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "common/geometry/order_statistics.hpp"
#include "common/pose_graph/gaussian_field.hpp"

namespace adit {
namespace {

constexpr double kSamePlaceM = 2.0;  // alternatives nearer than this are the same
constexpr double kSamePlaceRad = 0.2;
constexpr int kGroupsRevokedMax = 4;         // by one revision
constexpr int kReconsiderRoundsMax = 10;     // of revoking and choosing; usually fewer until stable
constexpr std::size_t kTogetherMin = 8;      // loop closures accepted by one optimisation
constexpr int kRoundsTogether = 3;           // of leaving out those that do not fit
constexpr std::size_t kMisfitShareMax = 4;   // 1 / share that may be left out
constexpr double kExplainedShare = 0.3;      // of a gate, by each: twice the expected chi-square
constexpr double kMedianChiSquare3 = 2.366;  // three degrees of freedom
constexpr std::size_t kClaimsPresumed = 10;  // loop closures whose errors are as claimed
constexpr double kNoiseMargin = 3.0;    // of the estimated noise: its distribution is not known
constexpr double kTrialsInVain = 30.0;  // of a search, in a file
constexpr double kTrialsPerLoopClosure = 0.02;
constexpr double kWrongPresumed = 1.0;  // loop closures, before any is decided
constexpr double kRightPresumed = 9.0;
constexpr double kWrongOddsMax = 0.1;  // that one which fits is wrong
constexpr double kNoiseMin = 0.02;
constexpr double kPlausibleGates = 1.5;  // the odometry is composed to first order only

std::string reason_of(const Association& a) {
  const bool now = a.chosen != Association::kNone;
  if (a.action == Association::Action::kProposed) {
    return now ? "the most likely alternative" : "no alternative is likely given the map";
  }
  if (!now) return "contradicted by later measurements";
  return a.previously_chosen == Association::kNone ? "likely after others were revoked"
                                                   : "another alternative is more likely";
}

}  // namespace

void LazyAssociation::add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information) {
  trial_.reset();
  grows_ |= was_tried_;
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

void LazyAssociation::add_map_after_gap(const UncertainPose& T_previous_local) {
  add_map(T_previous_local.T_from_to, T_previous_local.covariance.inverse());
  problem_.gaps.push_back(problem_.odometry.maps() - 2);
}

void LazyAssociation::add_bridge(const PoseConstraint& bridge) {
  trial_.reset();
  problem_.bridges.push_back(bridge);
}

std::vector<Association> LazyAssociation::decide(std::vector<LoopClosure> loop_closures,
                                                 std::int64_t utime) {
  const std::vector<int> groups(loop_closures.size(), kGroupByOdometry);
  return decide(std::move(loop_closures), groups, utime);
}

std::vector<Association> LazyAssociation::decide(std::vector<LoopClosure> loop_closures,
                                                 const std::vector<int>& groups,
                                                 std::int64_t utime) {
  std::vector<int> added;
  added.reserve(loop_closures.size());
  for (std::size_t i = 0; i < loop_closures.size(); ++i) {
    added.push_back(append(std::move(loop_closures[i]), groups[i]));
  }
  const std::vector<int> before = hypothesis_.chosen;
  if (params_.best_first) accept_likely(added);
  for (const int k : added) {
    if (trial().chosen(k) != Association::kNone) continue;
    // Maximum likelihood; if all alternatives are unlikely, backtrack in the tree (section 2.2).
    if (!choose_most_likely(trial(), k) && search_is_due(k)) {
      if (auto better = search(k)) set_hypothesis(std::move(*better));
    }
  }
  std::vector<Association> record;
  if (!added.empty()) record_changes(record, utime, before, as_index(added.front()));
  return record;
}

/// Accepts likely loop closures together, and then those that are likely with them.
void LazyAssociation::accept_likely(std::vector<int> loop_closures) {
  while (accept_together(loop_closures) > 0) {
    std::erase_if(loop_closures, [&](int k) { return trial().chosen(k) != Association::kNone; });
  }
}

/// Accepts those that are likely, each alone and all of them together. Returns their number. Fewer
/// than kTogetherMin are left to the caller: an update of the factor for each is cheaper.
std::size_t LazyAssociation::accept_together(const std::vector<int>& loop_closures) {
  if (loop_closures.size() < kTogetherMin) return 0;
  Choices choices;
  for (const int k : loop_closures) {
    const int alternative = most_likely(trial(), k);
    if (alternative != Association::kNone) choices.push_back({k, alternative});
  }
  bool agree = true;
  for (int round = 0; round < kRoundsTogether; ++round) {
    if (choices.size() < kTogetherMin) break;
    Choices misfits = accept_if_consistent(choices, false);
    if (!misfits.empty()) misfits = accept_if_consistent(choices, true);
    if (misfits.empty()) {
      disagreements_ += agree ? 0 : 1;
      return choices.size();
    }
    agree = false;
    if (kMisfitShareMax * misfits.size() > choices.size()) break;
    std::erase_if(choices,
                  [&](const auto& c) { return std::ranges::find(misfits, c) != misfits.end(); });
  }
  if (agree) return 0;
  ++disagreements_;
  std::vector<int> likely;
  for (const auto& [k, alternative] : choices) likely.push_back(k);
  const auto middle = likely.begin() + static_cast<std::ptrdiff_t>(likely.size() / 2);
  const std::size_t first = accept_together({likely.begin(), middle});
  return first + accept_together({middle, likely.end()});
}

/// Accepts them unless one does not fit then, or the objective rises by more than their
/// measurement errors explain. Returns those that do not fit, all if it is not known which.
LazyAssociation::Choices LazyAssociation::accept_if_consistent(const Choices& choices,
                                                               bool from_scratch) {
  Trial together(problem_, trial().hypothesis());
  const double before = together.objective();
  together.accept(choices, from_scratch);
  std::vector<int> accepted;
  for (const auto& [k, alternative] : choices) accepted.push_back(k);
  const auto without =
      together.leave_one_out(accepted, together.chosen_constraint(accepted.front()));
  Choices misfits;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (without[i].objective_decrease > gate()) misfits.push_back(choices[i]);
  }
  const double explained = gate() * (1.0 + kExplainedShare * static_cast<double>(choices.size()));
  const bool is_explained = together.objective() - before <= explained;
  if (misfits.empty() && !is_explained) return choices;
  if (misfits.empty()) trial_.emplace(std::move(together));
  return misfits;
}

Trial& LazyAssociation::trial() { return trial_ ? *trial_ : begin_trial(hypothesis_); }

/// A file is decided when all of its maps are known, in batches: there one factorisation for many
/// loop closures is cheaper than a tree. Gaps are known in files only.
Trial& LazyAssociation::begin_trial(Hypothesis hypothesis) {
  was_tried_ = true;
  trial_.reset();
  if (grows_ && problem_.gaps.empty() && problem_.bridges.empty()) {
    return trial_.emplace(problem_, std::move(hypothesis), map_field_);
  }
  return trial_.emplace(problem_, std::move(hypothesis));
}

/// A revised hypothesis, and the loop closures that it adds to the problem.
struct LazyAssociation::Revision {
  std::vector<LoopClosure> added;
  Hypothesis hypothesis;
};

std::vector<Association> LazyAssociation::revise(const Evidence& evidence, std::int64_t utime) {
  const double map_inconsistency = evidence.map_inconsistency(hypothesis_.T_map_local);
  if (!revision_is_due(map_inconsistency)) return {};
  std::optional<Revision> best = best_revision(evidence, map_inconsistency);
  revision_threshold_ = best ? 0.0 : 2.0 * map_inconsistency;
  if (!best) return {};
  return adopt(std::move(*best), utime);
}

/// After a revision without gain, the next is tried at twice the inconsistency.
bool LazyAssociation::revision_is_due(double map_inconsistency) {
  if (map_inconsistency < params_.gate) {
    revision_threshold_ = 0.0;
    return false;
  }
  return map_inconsistency >= revision_threshold_;
}

/// The revision that lowers the cost most: the latest group of loop closures is revoked, then also
/// the group before it, and so on (section 2.2). Empty if none lowers it.
std::optional<LazyAssociation::Revision> LazyAssociation::best_revision(const Evidence& evidence,
                                                                        double map_inconsistency) {
  std::optional<Revision> best;
  double gain = 0.0;
  for (const RevisionCandidate& candidate : latest_groups(problem_, trial(), kGroupsRevokedMax)) {
    Revision revision = reassociate(candidate, evidence);
    // The present hypothesis pays the gate for each loop closure that only the revision has.
    const auto added = static_cast<double>(revision.added.size());
    const double present = hypothesis_.cost + added * params_.gate + map_inconsistency;
    const double revised =
        revision.hypothesis.cost + evidence.map_inconsistency(revision.hypothesis.T_map_local);
    if (present - revised <= gain) continue;
    gain = present - revised;
    best = std::move(revision);
    if (!params_.best_first) break;
  }
  return best;
}

/// Revokes loop closures and associates the maps since the first of them again, at their new poses.
/// The problem is unchanged afterwards.
LazyAssociation::Revision LazyAssociation::reassociate(const RevisionCandidate& candidate,
                                                       const Evidence& evidence) {
  ++trials_;
  const AssociationProblem::Checkpoint before = problem_.checkpoint();
  const int first_map = problem_.loop_closures[as_index(candidate.loop_closures.front())].newer_map;
  Trial trial(problem_, trial_->hypothesis(),
              first_affected_map(candidate, candidate.loop_closures.front()));
  trial.revoke(candidate.loop_closures);
  bool localized = false;  // until then all possible places are proposed
  for (int map = first_map; map < problem_.odometry.maps(); ++map) {
    for (LoopClosure& loop_closure : evidence.loop_closures(map, trial, !localized)) {
      exclude_present_poses(loop_closure, first_map);
      if (loop_closure.alternatives.empty()) continue;
      add_to_problem(std::move(loop_closure));
      trial.add_undecided();
      const LoopClosure& added = problem_.loop_closures.back();
      const bool chosen = choose_most_likely(trial, added.id);
      localized |= chosen && added.alternatives.front().older_map < first_map;
    }
  }
  trial.reoptimize();
  Revision revision{{}, trial.hypothesis()};
  revision.hypothesis.cost = cost(revision.hypothesis);
  revision.added = problem_.roll_back(before);
  return revision;
}

/// Removes the alternatives that would put a map back to its present pose on maps before `first`:
/// these are not proposed again after the hypothesis that put it there is revoked.
void LazyAssociation::exclude_present_poses(LoopClosure& loop_closure, int first) const {
  const Pose2& present = hypothesis_.T_map_local[as_index(loop_closure.newer_map)];
  std::erase_if(loop_closure.alternatives, [&](const LoopClosureAlternative& a) {
    if (a.older_map >= first) return false;
    const Pose2 apart =
        between(present, hypothesis_.T_map_local[as_index(a.older_map)] * a.T_older_newer);
    return apart.translation().norm() < kSamePlaceM && std::abs(apart.theta) < kSamePlaceRad;
  });
}

/// Adds the loop closures of a revision to the problem and makes its hypothesis the current one.
std::vector<Association> LazyAssociation::adopt(Revision revision, std::int64_t utime) {
  std::vector<int> before = hypothesis_.chosen;
  const std::size_t first_new = before.size();
  before.resize(revision.hypothesis.chosen.size(), Association::kNone);
  for (LoopClosure& loop_closure : revision.added) append(std::move(loop_closure));
  set_hypothesis(std::move(revision.hypothesis));
  std::vector<Association> record;
  record_changes(record, utime, before, first_new);
  return record;
}

LazyAssociation::Checkpoint LazyAssociation::checkpoint() const {
  return {problem_.checkpoint(), hypothesis_, search_threshold_, revision_threshold_};
}

void LazyAssociation::roll_back(Checkpoint checkpoint) {
  trial_.reset();
  problem_.roll_back(checkpoint.problem);
  map_field_.truncate(checkpoint.problem.maps, checkpoint.problem.loop_closures);
  hypothesis_ = std::move(checkpoint.hypothesis);
  search_threshold_ = std::move(checkpoint.search_threshold);
  revision_threshold_ = checkpoint.revision_threshold;
}

void LazyAssociation::restore(const std::vector<Association>& associations) {
  for (const Association& a : associations) {
    if (a.loop_closure.id == static_cast<int>(problem_.loop_closures.size()))
      append(a.loop_closure);
    hypothesis_.chosen[as_index(a.loop_closure.id)] = a.chosen;
  }
  trial_.reset();
  was_tried_ = true;
  Trial trial(problem_, hypothesis_);
  trial.reoptimize();
  hypothesis_ = trial.hypothesis();
  hypothesis_.cost = cost(hypothesis_);
}

/// Adds a loop closure, undecided. Returns its id.
int LazyAssociation::append(LoopClosure loop_closure, int group) {
  add_to_problem(std::move(loop_closure), group);
  hypothesis_.chosen.push_back(Association::kNone);
  if (trial_) trial_->add_undecided();
  return problem_.loop_closures.back().id;
}

/// Adds a loop closure to the problem, but to no hypothesis.
void LazyAssociation::add_to_problem(LoopClosure loop_closure, int group) {
  if (group == kGroupByOdometry) {
    group = group_near(problem_.odometry, problem_.loop_closures, problem_.groups, loop_closure,
                       params_.group_gap_m);
    if (group < 0) group = problem_.group_count();
  }
  loop_closure.id = static_cast<int>(problem_.loop_closures.size());
  problem_.add_to_group(group);
  bool plausible = false;
  for (int a = 0; a < static_cast<int>(loop_closure.alternatives.size()); ++a) {
    plausible |= cycle_residual(problem_.odometry, constraint_of(loop_closure, a)).disagreement <
                 kPlausibleGates * params_.gate;
  }
  problem_.plausible.push_back(plausible);
  problem_.loop_closures.push_back(std::move(loop_closure));
}

/// The cost of rejecting a loop closure: higher if another of its group is chosen.
double LazyAssociation::gate(const Trial& trial, int loop_closure) const {
  const std::vector<int>& group = problem_.members_of_group_of(loop_closure);
  const bool supported =
      std::ranges::any_of(group, [&](int k) { return trial.chosen(k) != Association::kNone; });
  return noise_.value_or(1.0) * (supported ? params_.gate_supported : params_.gate);
}

/// −2 log-likelihood up to a constant: the objective (section 2.3) and the costs of the decisions.
double LazyAssociation::cost(const Hypothesis& hypothesis) const {
  double cost = hypothesis.objective;
  for (std::size_t k = 0; k < hypothesis.chosen.size(); ++k) {
    cost += hypothesis.chosen[k] == Association::kNone
                ? gate()
                : penalty(problem_.loop_closures[k], hypothesis.chosen[k]);
  }
  return cost;
}

/// The alternative that costs least, if that is less than rejecting the loop closure.
int LazyAssociation::most_likely(Trial& trial, int loop_closure) const {
  const LoopClosure& c = problem_.loop_closures[as_index(loop_closure)];
  double least = gate(trial, loop_closure);
  int best = Association::kNone;
  for (int a = 0; a < static_cast<int>(c.alternatives.size()); ++a) {
    const double objective_increase = trial.objective_increase(constraint_of(c, a)) + penalty(c, a);
    if (objective_increase >= least) continue;
    least = objective_increase;
    best = a;
  }
  return best;
}

bool LazyAssociation::choose_most_likely(Trial& trial, int loop_closure) const {
  const int best = most_likely(trial, loop_closure);
  if (best == Association::kNone) return false;
  trial.accept(loop_closure, best);
  return true;
}

/// Makes a hypothesis the current one, optimised completely.
void LazyAssociation::set_hypothesis(Hypothesis hypothesis) {
  const bool partially_optimized = hypothesis.partially_optimized;
  begin_trial(std::move(hypothesis));
  if (partially_optimized) trial_->reoptimize();
}

/// Adopts the hypothesis of the trial, and records the decisions that differ from `before`.
/// `first_new`: the first loop closure that is decided for the first time.
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

/// A search is made for the first contradiction of a group, then for the second, the fourth, and so
/// on: one more contradiction of the same kind rarely changes the result. Never for a loop closure
/// that the odometry excludes.
bool LazyAssociation::search_is_due(int loop_closure) {
  if (!problem_.plausible[as_index(loop_closure)] || is_search_exhausted()) return false;
  int contradictions = 0;
  for (const int k : problem_.members_of_group_of(loop_closure)) {
    if (k > loop_closure || !problem_.plausible[as_index(k)]) continue;
    contradictions += trial_->chosen(k) == Association::kNone ? 1 : 0;
  }
  int& due = search_threshold_[problem_.groups[as_index(loop_closure)]];
  if (contradictions < due) return false;
  due = 2 * contradictions;
  return true;
}

/// Where the noise is estimated, in a file: whether hypotheses were evaluated in vain so often that
/// contradictions are those of wrong loop closures. They are rejected then.
bool LazyAssociation::is_search_exhausted() const {
  if (!noise_) return false;
  const auto decided = static_cast<double>(hypothesis_.chosen.size());
  return trials_in_vain_ > kTrialsInVain + kTrialsPerLoopClosure * decided;
}

/// Searches the tree of decisions for a hypothesis in which the loop closure is chosen and that
/// costs less than the present one. Empty if none is found within the budget.
std::optional<Hypothesis> LazyAssociation::search(int loop_closure) {
  Hypothesis present = trial_->hypothesis();
  double least = cost(present);
  const std::vector<RevisionCandidate> order =
      params_.best_first ? revision_candidates(problem_, *trial_, loop_closure, gate(), least)
                         : latest_groups(problem_, *trial_, params_.trials_max);
  std::optional<Hypothesis> best;
  int budget = params_.trials_max;
  for (const RevisionCandidate& candidate : order) {
    if (budget-- == 0 || candidate.bound >= least) break;
    auto hypothesis = hypothesis_accepting(loop_closure, candidate);
    if (!hypothesis || hypothesis->cost >= least) {
      ++trials_in_vain_;
      continue;
    }
    least = hypothesis->cost;
    best = std::move(hypothesis);
    if (!params_.best_first) break;
  }
  return best;
}

/// The earliest map that a revision moves: a loop begins at its older map.
int LazyAssociation::first_affected_map(const RevisionCandidate& candidate,
                                        int loop_closure) const {
  int first = problem_.chain.empty() ? 0 : problem_.loop_closures[as_index(loop_closure)].newer_map;
  const auto include = [&](int k) {
    for (const LoopClosureAlternative& a : problem_.loop_closures[as_index(k)].alternatives) {
      first = std::min(first, a.older_map);
    }
  };
  include(loop_closure);
  for (const int k : candidate.loop_closures) include(k);
  return first;
}

/// The hypothesis in which the candidate's loop closures are revoked, `loop_closure` is chosen, and
/// the loop closures between are decided again. Empty if `loop_closure` is unlikely even then.
std::optional<Hypothesis> LazyAssociation::hypothesis_accepting(
    int loop_closure, const RevisionCandidate& candidate) {
  ++trials_;
  const int first = first_affected_map(candidate, loop_closure);
  Trial trial(problem_, trial_->hypothesis(), first);
  trial.revoke(candidate.loop_closures);
  if (!choose_most_likely(trial, loop_closure)) return std::nullopt;
  for (int k = candidate.loop_closures.front(); k < loop_closure; ++k) {
    const bool undecided = trial.chosen(k) == Association::kNone && problem_.plausible[as_index(k)];
    const bool affected = problem_.loop_closures[as_index(k)].newer_map >= first;
    if (undecided && affected) choose_most_likely(trial, k);
  }
  trial.reoptimize();
  Hypothesis hypothesis = trial.hypothesis();
  hypothesis.cost = cost(hypothesis);
  return hypothesis;
}

/// Revokes the loop closure whose removal lowers the objective most, and the next, while the
/// decrease exceeds the cost of rejecting it.
void LazyAssociation::revoke_misfits(Trial& trial) const {
  while (true) {
    const std::vector<int> chosen = trial.chosen_loop_closures();
    if (chosen.empty()) return;
    const auto without = trial.leave_one_out(chosen, trial.chosen_constraint(chosen.front()));
    const auto worst = std::max_element(without.begin(), without.end(), [](auto& a, auto& b) {
      return a.objective_decrease < b.objective_decrease;
    });
    const int misfit = chosen[static_cast<std::size_t>(worst - without.begin())];
    if (worst->objective_decrease <= gate(trial, misfit)) return;
    trial.revoke({misfit});
  }
}

std::vector<Association> LazyAssociation::postpone(std::vector<LoopClosure> loop_closures,
                                                   const std::vector<int>& groups,
                                                   std::int64_t utime) {
  static_cast<void>(trial());  // whose hypothesis is recorded
  const std::vector<int> before = hypothesis_.chosen;
  for (std::size_t i = 0; i < loop_closures.size(); ++i) {
    append(std::move(loop_closures[i]), groups[i]);
  }
  std::vector<Association> record;
  record_changes(record, utime, before, before.size());
  return record;
}

double LazyAssociation::chance(const LoopClosure& loop_closure) {
  return chance_of_fit(trial().residual_covariance(constraint_of(loop_closure, 0)), gate(),
                       problem_.odometry.area_m2());
}

bool LazyAssociation::has_contradictory_group() const {
  const auto is_accepted = [&](int k) {
    return hypothesis_.chosen[as_index(k)] != Association::kNone;
  };
  std::optional<GaussianField> field;
  for (const std::vector<int>& members : problem_.members) {
    std::vector<PoseConstraint> removed;
    for (const int k : members) {
      if (!is_accepted(k)) continue;
      const PoseConstraint c =
          constraint_of(problem_.loop_closures[as_index(k)], hypothesis_.chosen[as_index(k)]);
      if (!field) field.emplace(graph_of(problem_, hypothesis_));
      if (field->remove(c)) removed.push_back(c);
    }
    const auto misfits = std::ranges::count_if(
        removed, [&](const PoseConstraint& c) { return field->objective_increase(c) > gate(); });
    if (removed.size() > 1 && 2 * misfits > std::ssize(removed)) return true;
    for (const PoseConstraint& c : removed) field->add(c);
  }
  return false;
}

bool LazyAssociation::is_evidence(double chance) const {
  const auto rejected =
      static_cast<double>(std::ranges::count(hypothesis_.chosen, Association::kNone));
  const double accepted = static_cast<double>(hypothesis_.chosen.size()) - rejected;
  const double odds = (rejected + kWrongPresumed) / (accepted + kRightPresumed);
  return chance * odds < kWrongOddsMax;
}

void LazyAssociation::estimate_noise() {
  const std::vector<int> chosen = trial().chosen_loop_closures();
  if (chosen.empty()) return;
  std::vector<double> errors(kClaimsPresumed, kMedianChiSquare3);
  for (const auto& without :
       trial().leave_one_out(chosen, trial().chosen_constraint(chosen.front()))) {
    errors.push_back(without.objective_decrease);
  }
  noise_ = std::clamp(kNoiseMargin * median(std::move(errors)) / kMedianChiSquare3, kNoiseMin, 1.0);
}

bool LazyAssociation::raise_noise(double variance_factor) {
  if (noise_.value_or(1.0) < 1.0) return false;
  noise_ = variance_factor;
  return true;
}

/// Where wrong loop closures fit by chance, a rejected one is not accepted for fitting now.
bool LazyAssociation::may_reconsider(int loop_closure) {
  if (!noise_) return true;
  return is_evidence(chance(problem_.loop_closures[as_index(loop_closure)]));
}

std::vector<Association> LazyAssociation::reconsider(std::int64_t utime) {
  std::vector<Association> record;
  Trial& present = trial();
  const std::vector<int> before = hypothesis_.chosen;
  for (int round = 0; round < kReconsiderRoundsMax; ++round) {
    const std::vector<int> last = present.decisions();
    revoke_misfits(present);
    for (int k = 0; k < static_cast<int>(before.size()); ++k) {
      if (present.chosen(k) == Association::kNone && may_reconsider(k)) {
        choose_most_likely(present, k);
      }
    }
    present.reoptimize();
    if (present.decisions() == last) break;
  }
  record_changes(record, utime, before, before.size());
  return record;
}

}  // namespace adit
