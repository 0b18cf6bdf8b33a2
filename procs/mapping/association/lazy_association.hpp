// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/evidence.hpp"
#include "procs/mapping/association/suspects.hpp"
#include "procs/mapping/association/trial.hpp"

namespace adit {

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
  std::vector<Association> decide(std::vector<Closure> closures, std::int64_t utime);

  /// `belief`, to ask what else is known.
  [[nodiscard]] Trial& trial();

  /// The likelihood of the newest map is monitored: where it is low, the latest groups of closures
  /// are undone, one after the other, the maps since then are associated afresh, and what makes the
  /// newest map likely stays (paper, section 2.2). What was decided, in order.
  std::vector<Association> revise(const Evidence& evidence, std::int64_t utime);

  /// How things stand, to come back to.
  struct Mark {
    int maps = 0;
    std::size_t closures = 0;
    Belief belief;
    std::map<int, int> search_due;
    double surprise_due = 0.0;
    int groups = 0;
  };
  [[nodiscard]] Mark mark() const;
  /// Forgets the maps that came since then, and all that was decided.
  void go_back_to(Mark mark);

  /// Takes over decisions that were made before, in their order, for the maps that were added.
  void restore(const std::vector<Association>& associations);

  /// Lets go of what fits badly by now and asks all that is left out once more, as at the end of a
  /// recording.
  std::vector<Association> reconsider(std::int64_t utime);

  [[nodiscard]] const AssociationProblem& problem() const { return problem_; }
  [[nodiscard]] const Belief& belief() const { return belief_; }
  /// Beliefs that were worked out in searches so far.
  [[nodiscard]] int trials() const { return trials_; }

 private:
  [[nodiscard]] int group_of(const Closure& closure) const;
  void append(Closure closure);
  void enter(Closure closure);
  void decide_one(int closure);
  void believe(Belief belief);
  bool choose(Trial& trial, int closure) const;
  [[nodiscard]] double gate(const Trial& trial, int closure) const;
  [[nodiscard]] double cost(const Belief& belief) const;
  bool search_is_due(int closure);
  std::optional<Belief> search(int closure);
  [[nodiscard]] int first_concerned(const Suspects& undone, int closure) const;
  void let_go_of_misfits(Trial& trial) const;
  std::optional<Belief> without(const Suspects& undone, int closure);
  struct Revision;
  void leave_out_what_is_believed(Closure& closure, int first) const;
  Revision associate_afresh(const Suspects& undone, const Evidence& evidence);
  void adopt(std::vector<Association>& record, std::int64_t utime, const std::vector<int>& before,
             std::size_t first_new);

  LazyAssociationParams params_;
  AssociationProblem problem_;
  Belief belief_;
  std::optional<Trial> trial_;     ///< `belief_`, with its field
  std::map<int, int> search_due_;  ///< of a group: at how many contradictions
  double surprise_due_ = 0.0;      ///< from which a revision is tried
  int groups_ = 0;
  int trials_ = 0;
};

}  // namespace adit
