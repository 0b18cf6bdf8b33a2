// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/pose_graph/gaussian_field.hpp"
#include "procs/mapping/association/association_problem.hpp"

namespace adit {

/// A belief in the course of being changed. To try an association costs a look at a few columns of
/// the factor, to make or revoke one a rank update; the field is linearised anew where the maps
/// have turned so far that the old linearisation would mislead.
class Trial {
 public:
  /// `problem` must outlive this; `belief` is settled (its poses are at their mode). The maps
  /// before `first` stay where they are, so that what it costs depends on the loop that is looked
  /// at and not on the map.
  Trial(const AssociationProblem& problem, Hypothesis hypothesis, int first = 0);

  /// With poses and objective as they are now; `cost` is the caller's.
  [[nodiscard]] Hypothesis hypothesis() const;
  [[nodiscard]] double objective() const;
  [[nodiscard]] const std::vector<int>& decisions() const { return hypothesis_.chosen; }
  /// Those of which an alternative is chosen, in ascending order.
  [[nodiscard]] std::vector<int> chosen_loop_closures() const;
  [[nodiscard]] int chosen(int loop_closure) const {
    return hypothesis_.chosen[static_cast<std::size_t>(loop_closure)];
  }

  /// The problem has a closure more; none is chosen.
  void add_undecided() { hypothesis_.chosen.push_back(Association::kNone); }

  /// By how much the objective would rise with one constraint more: chi-square with three degrees
  /// of freedom where the constraint is right.
  [[nodiscard]] double objective_increase(const PoseConstraint& constraint) {
    return field().objective_increase(in_graph_from(constraint, hypothesis_, first_));
  }
  /// For each of the chosen closures, what `price` would be and how far the objective would fall if
  /// it were revoked.
  [[nodiscard]] std::vector<GaussianField::LeaveOneOut> leave_one_out(
      const std::vector<int>& loop_closures, const PoseConstraint& query);

  /// For each map before `map`, the covariance of the pose of `map` in it: of (x, y, θ) in the
  /// frame of `map`. Maps that are held fixed are taken as certain among each other.
  [[nodiscard]] std::vector<Eigen::Matrix3d> covariances_to(int map);

  /// Chooses an alternative of a closure for which none is chosen.
  void accept(int loop_closure, int alternative);
  /// Chooses none for closures that have one.
  void revoke(const std::vector<int>& loop_closures);

  /// Moves the maps to the mode, not to first order but truly. `afresh`: whatever their poses are,
  /// as after one that turned the maps far round.
  void reoptimize(bool from_scratch = false);

 private:
  [[nodiscard]] GaussianField& field();
  [[nodiscard]] PoseConstraint chosen_constraint(int loop_closure) const;
  void set_poses(const std::vector<Pose2>& nodes, Hypothesis& hypothesis) const;
  [[nodiscard]] bool has_fixed_end() const;

  const AssociationProblem& problem_;
  Hypothesis hypothesis_;  ///< poses and objective as last settled
  int first_;
  double fixed_ = 0.0;                  ///< part of the objective that is not in the field
  std::optional<GaussianField> field_;  ///< linearised there; nothing: not asked for yet
};

}  // namespace adit
