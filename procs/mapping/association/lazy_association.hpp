// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/association.hpp"
#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/revision_candidates.hpp"
#include "procs/mapping/association/trial.hpp"

namespace adit {

/// What the local maps themselves have to say, asked for again under each belief that is tried.
class Evidence {
 public:
  virtual ~Evidence() = default;

  /// The places that a map may have come back to, where the trial believes it to be: as many
  /// closures as are worth deciding, their ids without meaning. `thorough`: less likely places too.
  [[nodiscard]] virtual std::vector<LoopClosure> loop_closures(int map, Trial& trial,
                                                               bool thorough) const = 0;

  /// How unlikely the newest map is where it lies: −2 log-likelihood of what it shows against what
  /// older maps show of the same places; 0 where it agrees or shows what is new.
  [[nodiscard]] virtual double map_inconsistency(const std::vector<Pose2>& T_map_local) const = 0;
};

struct LazyAssociationParams {
  double gate = 21.1;            ///< what "none" costs: chi-square, 3 degrees of freedom, 0.9999
  double gate_supported = 42.0;  ///< up to here where others of its group are chosen
  double group_gap_m = 12.0;     ///< closures this close along the way at both ends are a group
  bool best_first = true;        ///< order of search; else the paper's, back through the latest
  int trials_max = 8;            ///< beliefs that are worked out for one contradiction

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
/// association in SLAM", ISRR 2003). For each closure the most likely alternative is taken, or none
/// if all are unlikely. Where what was just measured is unlikely given the map, earlier decisions
/// are undone, the measurement is taken for true, and what came after is decided again; the belief
/// that explains everything at the least cost stays.
///
/// Costs are −2 log-likelihoods: the objective of the pose graph, a gate for each closure that is
/// left out, and for an alternative by how much it is less likely than the best one.
///
/// Two orders of search: best first, by a bound on what a belief may cost; or the paper's, back
/// through the latest groups of closures until the newest measurement is likely.
class LazyAssociation {
 public:
  explicit LazyAssociation(const LazyAssociationParams& params) : params_(params) {}
  LazyAssociation(const LazyAssociation&) = delete;
  LazyAssociation& operator=(const LazyAssociation&) = delete;

  /// The next local map: `T_previous_local` and its information (see LocalMap). The first call is
  /// for map 0, for which they mean nothing.
  void add_map(const Pose2& T_previous_local, const Eigen::Matrix3d& information);

  /// Decides on the closures of the newest map, and again on earlier ones if need be. What was
  /// decided, in order; `utime` is that of the newest measurement.
  std::vector<Association> decide(std::vector<LoopClosure> loop_closures, std::int64_t utime);

  /// `belief`, to ask what else is known.
  [[nodiscard]] Trial& trial();

  /// The likelihood of the newest map is monitored: where it is low, the latest groups of closures
  /// are undone, one after the other, the maps since then are associated afresh, and what makes the
  /// newest map likely stays (paper, section 2.2). What was decided, in order.
  std::vector<Association> revise(const Evidence& evidence, std::int64_t utime);

  /// How things stand, to come back to.
  struct Checkpoint {
    int maps = 0;
    std::size_t loop_closures = 0;
    Hypothesis hypothesis;
    std::map<int, int> search_threshold;
    double revision_threshold = 0.0;
    int groups = 0;
  };
  [[nodiscard]] Checkpoint checkpoint() const;
  /// Forgets the maps that came since then, and all that was decided.
  void roll_back(Checkpoint checkpoint);

  /// Takes over decisions that were made before, in their order, for the maps that were added.
  void restore(const std::vector<Association>& associations);

  /// Lets go of what fits badly by now and asks all that is left out once more, as at the end of a
  /// recording.
  std::vector<Association> reconsider(std::int64_t utime);

  [[nodiscard]] const AssociationProblem& problem() const { return problem_; }
  [[nodiscard]] const Hypothesis& hypothesis() const { return hypothesis_; }
  /// Beliefs that were worked out in searches so far.
  [[nodiscard]] int trials() const { return trials_; }

 private:
  [[nodiscard]] int group_of(const LoopClosure& loop_closure) const;
  void append(LoopClosure loop_closure);
  void add_to_problem(LoopClosure loop_closure);
  void decide_one(int loop_closure);
  void set_hypothesis(Hypothesis hypothesis);
  bool choose(Trial& trial, int loop_closure) const;
  [[nodiscard]] double gate(const Trial& trial, int loop_closure) const;
  [[nodiscard]] double cost(const Hypothesis& hypothesis) const;
  bool search_is_due(int loop_closure);
  std::optional<Hypothesis> search(int loop_closure);
  [[nodiscard]] int first_affected_map(const RevisionCandidate& candidate, int loop_closure) const;
  void revoke_misfits(Trial& trial) const;
  std::optional<Hypothesis> without(const RevisionCandidate& candidate, int loop_closure);
  struct Revision;
  void exclude_accepted_alternatives(LoopClosure& loop_closure, int first) const;
  Revision reassociate(const RevisionCandidate& candidate, const Evidence& evidence);
  void record_changes(std::vector<Association>& record, std::int64_t utime,
                      const std::vector<int>& before, std::size_t first_new);

  LazyAssociationParams params_;
  AssociationProblem problem_;
  Hypothesis hypothesis_;
  std::optional<Trial> trial_;           ///< `belief_`, with its field
  std::map<int, int> search_threshold_;  ///< of a group: at how many contradictions
  double revision_threshold_ = 0.0;      ///< from which a revision is tried
  int groups_ = 0;
  int trials_ = 0;
};

}  // namespace adit
