// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/map_field.hpp"
#include "procs/mapping/association/revision_candidates.hpp"
#include "procs/mapping/association/trial.hpp"

namespace adit {

/// Evidence from the local maps themselves, evaluated under each hypothesis that is tried.
class Evidence {
 public:
  virtual ~Evidence() = default;

  /// Loop closures of a map at its pose in the trial, their ids not set: as many as are worth a
  /// decision. `thorough`: less likely places too.
  [[nodiscard]] virtual std::vector<LoopClosure> loop_closures(int map, Trial& trial,
                                                               bool thorough) const = 0;

  /// Inconsistency of the newest maps at these poses: −2 log-likelihood of their observations given
  /// those of older maps of the same places; 0 where they agree or observe new places.
  [[nodiscard]] virtual double map_inconsistency(const std::vector<Pose2>& T_map_local) const = 0;
};

struct LazyAssociationParams {
  double gate = 21.1;            ///< cost of rejecting: chi-square, 3 degrees of freedom, 0.9999
  double gate_supported = 42.0;  ///< cost where another loop closure of its group is chosen
  double group_gap_m = 12.0;  ///< loop closures within this path length at both ends form a group
  bool best_first = true;  ///< order of search; false: that of the paper, backwards from the latest
  int trials_max = 8;      ///< maximum number of hypotheses evaluated per contradiction

  template <class V>
  void visit(V& v) {
    v("gate", gate, above(0.0));
    v("gate_supported", gate_supported, above(0.0));
    v("group_gap_m", group_gap_m, at_least(0.0));
    v("best_first", best_first);
    v("trials_max", trials_max, at_least(1));
  }
};

/// Lazy data association (paper, section 2.2; Hähnel, Burgard, Wegbreit, Thrun, "Towards lazy data
/// association in SLAM", ISRR 2003). For each loop closure the most likely alternative is chosen,
/// or none if all are unlikely. If a new measurement is unlikely given the map, earlier decisions
/// are revoked, the measurement is assumed correct, and the later loop closures are decided again;
/// the hypothesis of least cost is kept.
///
/// Costs are −2 log-likelihoods: the objective of the pose graph, a gate for each rejected loop
/// closure, and for a chosen alternative its likelihood relative to the most likely one.
///
/// Two orders of search: best first, by a lower bound of the cost of a hypothesis; or that of the
/// paper, backwards through the latest groups of loop closures until the newest measurement is
/// likely.
class LazyAssociation {
 public:
  explicit LazyAssociation(const LazyAssociationParams& params) : params_(params) {}
  LazyAssociation(const LazyAssociation&) = delete;
  LazyAssociation& operator=(const LazyAssociation&) = delete;

  /// Adds the next local map: `T_previous_local` and its information (see LocalMap). For map 0, the
  /// first call, both are ignored.
  void add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information);

  /// Adds the next local map where no constraint links it with the previous one: its displacement
  /// is composed along constraints that bridge the gap, to be added by `add_bridge`.
  void add_map_after_gap(const UncertainPose& T_previous_local);
  /// Adds a constraint, to the later of two maps, that is certain and links the parts of a chain
  /// with gaps.
  void add_bridge(const PoseConstraint& bridge);

  /// Decides loop closures, usually those of the newest map, and revises earlier decisions if
  /// necessary. Returns the decisions in order; `utime` is that of the newest measurement. Eight or
  /// more that are likely are accepted by one optimisation; where they do not agree with each
  /// other, by halves.
  std::vector<Association> decide(std::vector<LoopClosure> loop_closures, std::int64_t utime);

  /// The same in any order of their newer maps, where the groups are known before: that of each
  /// loop closure, by any number from 0.
  std::vector<Association> decide(std::vector<LoopClosure> loop_closures,
                                  const std::vector<int>& groups, std::int64_t utime);

  /// The current hypothesis, for further queries.
  [[nodiscard]] Trial& trial();

  /// Monitors the likelihood of the newest maps (paper, section 2.2): if it is low, the latest
  /// groups of loop closures are revoked one after the other, the maps since then are associated
  /// again, and the revision that makes the newest maps likely is adopted. Returns the decisions in
  /// order.
  std::vector<Association> revise(const Evidence& evidence, std::int64_t utime);

  /// The complete state at some time.
  struct Checkpoint {
    AssociationProblem::Checkpoint problem;
    Hypothesis hypothesis;
    std::map<int, int> search_threshold;
    double revision_threshold = 0.0;
  };
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Returns to the state of a checkpoint: removes the maps and decisions made since.
  void roll_back(Checkpoint checkpoint);

  /// Replays recorded decisions, in their order, for the maps that were added.
  void restore(const std::vector<Association>& associations);

  /// Revokes loop closures that fit badly by now and decides all rejected ones again, as at the end
  /// of a recording.
  std::vector<Association> reconsider(std::int64_t utime);

  /// Adds loop closures that the present map cannot tell from wrong ones, to be decided by
  /// `reconsider`. Returns that they are rejected.
  std::vector<Association> postpone(std::vector<LoopClosure> loop_closures,
                                    const std::vector<int>& groups, std::int64_t utime);

  /// Whether a group of accepted loop closures does not fit the map without it: of two or more,
  /// most exceed the gate. Wrong ones that agree with each other each fit with the others. Costs
  /// two updates of the factor for each.
  [[nodiscard]] bool has_contradictory_group() const;

  /// The probability that the present map would accept this loop closure if it were wrong: by
  /// chance, since it is then as likely to be anywhere in the map.
  [[nodiscard]] double chance(const LoopClosure& loop_closure);
  /// Whether a loop closure that fits with this chance is rather right than wrong, if as many are
  /// wrong as were rejected so far.
  [[nodiscard]] bool is_evidence(double chance) const;

  /// Estimates how much smaller the errors of the loop closures are than their information claims,
  /// from the median of what each adds to the objective, and lowers the gates accordingly. For
  /// files whose information has an arbitrary scale; the gates are not raised.
  void estimate_noise();

  /// Raises the gates to the errors that a map shows as a whole: `variance_factor` times those
  /// stated, above 1. False, with the gates unchanged, if the loop closures have smaller errors.
  bool raise_noise(double variance_factor);

  [[nodiscard]] const AssociationProblem& problem() const { return problem_; }
  [[nodiscard]] const Hypothesis& hypothesis() const { return hypothesis_; }
  /// Number of hypotheses evaluated in searches so far.
  [[nodiscard]] int trials() const { return trials_; }
  /// Number of times that likely loop closures did not agree with each other so far.
  [[nodiscard]] int disagreements() const { return disagreements_; }

 private:
  struct Revision;

  static constexpr int kGroupByOdometry = -1;
  int append(LoopClosure loop_closure, int group = kGroupByOdometry);
  void add_to_problem(LoopClosure loop_closure, int group = kGroupByOdometry);

  [[nodiscard]] int most_likely(Trial& trial, int loop_closure) const;
  bool choose_most_likely(Trial& trial, int loop_closure) const;
  void accept_likely(std::vector<int> loop_closures);
  std::size_t accept_together(const std::vector<int>& loop_closures);
  using Choices = std::vector<std::array<int, 2>>;  // (loop closure, alternative)
  Choices accept_if_consistent(const Choices& choices, bool from_scratch);
  [[nodiscard]] double gate(const Trial& trial, int loop_closure) const;
  [[nodiscard]] double gate() const { return noise_.value_or(1.0) * params_.gate; }
  [[nodiscard]] double cost(const Hypothesis& hypothesis) const;

  bool search_is_due(int loop_closure);
  [[nodiscard]] bool is_search_exhausted() const;
  std::optional<Hypothesis> search(int loop_closure);
  std::optional<Hypothesis> hypothesis_accepting(int loop_closure,
                                                 const RevisionCandidate& candidate);
  [[nodiscard]] int first_affected_map(const RevisionCandidate& candidate, int loop_closure) const;

  bool revision_is_due(double map_inconsistency);
  std::optional<Revision> best_revision(const Evidence& evidence, double map_inconsistency);
  Revision reassociate(const RevisionCandidate& candidate, const Evidence& evidence);
  void exclude_present_poses(LoopClosure& loop_closure, int first) const;
  std::vector<Association> adopt(Revision revision, std::int64_t utime);

  void revoke_misfits(Trial& trial) const;
  [[nodiscard]] bool may_reconsider(int loop_closure);
  Trial& begin_trial(Hypothesis hypothesis);
  void set_hypothesis(Hypothesis hypothesis);
  void record_changes(std::vector<Association>& record, std::int64_t utime,
                      const std::vector<int>& before, std::size_t first_new);

  LazyAssociationParams params_;
  AssociationProblem problem_;
  Hypothesis hypothesis_;
  MapField map_field_;                   ///< of the current hypothesis while the map grows
  bool was_tried_ = false;               ///< a trial was made
  bool grows_ = false;                   ///< a map was added after that
  std::optional<Trial> trial_;           ///< `hypothesis_` with its field; empty: not yet needed
  std::map<int, int> search_threshold_;  ///< by group: contradictions at which to search next
  double revision_threshold_ = 0.0;      ///< inconsistency at which to revise next
  std::optional<double> noise_;          ///< factor of the gates, where the noise is estimated
  int trials_ = 0;
  int trials_in_vain_ = 0;
  int disagreements_ = 0;
};

}  // namespace adit
