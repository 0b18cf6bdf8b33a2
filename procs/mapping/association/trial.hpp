// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/pose_graph/gaussian_field.hpp"
#include "common/pose_graph/optimize.hpp"
#include "procs/mapping/association/association_problem.hpp"
#include "procs/mapping/association/map_field.hpp"

namespace adit {

/// An older local map that may be near a newer one.
struct NearMap {
  int older = 0;
  /// Of the pose of the newer map in it: of (x, y, θ) in the frame of the newer.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// A hypothesis that is being modified. Evaluating an association costs the solution for a few
/// columns of the factor, accepting one a rank update, revoking an optimisation; the field is
/// linearised again after large rotations of the maps, which invalidate the old linearisation.
class Trial {
 public:
  /// `problem` must outlive this object; the poses of `hypothesis` are at their mode. The maps
  /// before `first` are held fixed, so that the cost depends on the size of the loop and not on
  /// that of the map.
  Trial(const AssociationProblem& problem, Hypothesis hypothesis, int first = 0);
  /// A trial of the complete map in `map_field`, which outlives this object and follows the
  /// hypothesis, now and with each change: the cost depends on what differs.
  Trial(const AssociationProblem& problem, Hypothesis hypothesis, MapField& map_field);

  /// The hypothesis with its current poses and objective; `cost` is set by the caller.
  [[nodiscard]] Hypothesis hypothesis() const;
  [[nodiscard]] double objective() const;
  [[nodiscard]] const std::vector<int>& decisions() const { return hypothesis_.chosen; }
  /// The loop closures with a chosen alternative, in ascending order.
  [[nodiscard]] std::vector<int> chosen_loop_closures() const;
  [[nodiscard]] int chosen(int loop_closure) const {
    return hypothesis_.chosen[static_cast<std::size_t>(loop_closure)];
  }

  /// The constraint between local maps of a chosen loop closure.
  [[nodiscard]] PoseConstraint chosen_constraint(int loop_closure) const;

  /// Adds an undecided loop closure, after it was added to the problem.
  void add_undecided() { hypothesis_.chosen.push_back(Association::kNone); }

  /// Increase of the objective by one more constraint: chi-square with three degrees of freedom if
  /// the constraint is correct.
  [[nodiscard]] double objective_increase(const PoseConstraint& constraint) {
    if (map_field_ != nullptr) return map_field_->field().objective_increase(constraint);
    return field().objective_increase(in_graph_from(constraint, hypothesis_, first_));
  }
  /// Covariance of the residual of one more constraint, if it is correct: of what is predicted and
  /// of what is measured.
  [[nodiscard]] Eigen::Matrix3d residual_covariance(const PoseConstraint& constraint) {
    if (map_field_ != nullptr) {
      return map_field_->field().predicted_covariance(constraint) +
             measured_by(constraint).covariance;
    }
    return field().predicted_covariance(in_graph_from(constraint, hypothesis_, first_)) +
           measured_by(constraint).covariance;
  }
  /// For each of these chosen loop closures, the field without it: the decrease of the objective,
  /// and the increase by `query` then.
  [[nodiscard]] std::vector<GaussianField::LeaveOneOut> leave_one_out(
      const std::vector<int>& loop_closures, const PoseConstraint& query);

  /// Of these chosen loop closures the `most` whose removal may change the cost of `query` most.
  [[nodiscard]] std::vector<int> most_coupled(const std::vector<int>& loop_closures,
                                              const PoseConstraint& query, std::size_t most);

  /// For each map before `map`, the covariance of the pose of `map` in it: of (x, y, θ) in the
  /// frame of `map`. Maps held fixed have no relative uncertainty.
  [[nodiscard]] std::vector<Eigen::Matrix3d> covariances_to(int map);

  /// The same for one map; in a map field without those of the others.
  [[nodiscard]] Eigen::Matrix3d covariance(int older, int map);

  /// How the pose of `map` in map 0 follows an error of the displacement that ends at `to`, both of
  /// (x, y, θ), in the frames of `map` and of `to`. Empty outside a map field.
  [[nodiscard]] std::optional<Eigen::Matrix3d> displacement_response(int map, int to) const;

  /// The maps before `map` of which something within `reach_m` of the origin, by map, may be within
  /// the reach of `map`, in the gate of `sigmas` standard deviations of their relative position;
  /// some others too. In a map field the cost depends on how many there are: a stretch of the path
  /// is left out by the covariance of one of its maps and the odometry along it, which bounds that
  /// of the others.
  [[nodiscard]] std::vector<NearMap> near_maps(int map, std::span<const double> reach_m,
                                               double sigmas);

  /// Of the maps before `end`, the covariance as above of the one relative to which the position of
  /// `map` is most certain; searched likewise.
  [[nodiscard]] Eigen::Matrix3d least_covariance(int map, int end);

  /// T_map_local of all maps.
  [[nodiscard]] std::vector<Pose2> poses() const;

  /// Chooses an alternative of an undecided loop closure.
  void accept(int loop_closure, int alternative);
  /// Chooses alternatives of several undecided loop closures, (loop closure, alternative), by one
  /// optimisation of all maps: of few steps from their poses, or `from_scratch`.
  void accept(const std::vector<std::array<int, 2>>& choices, bool from_scratch);
  /// Revokes chosen loop closures.
  void revoke(const std::vector<int>& loop_closures);

  /// Moves the maps to the mode by iterated optimisation, not only to first order. `from_scratch`:
  /// with an initialisation independent of their poses, as after a large rotation.
  void reoptimize(bool from_scratch = false, int iterations_max = OptimizeParams{}.iterations_max);

 private:
  [[nodiscard]] GaussianField& field();
  [[nodiscard]] std::vector<PoseConstraint> constraints_in_field(
      const std::vector<int>& loop_closures) const;
  void set_poses(const std::vector<Pose2>& nodes, Hypothesis& hypothesis) const;
  [[nodiscard]] bool has_fixed_end() const;
  void relinearise();
  [[nodiscard]] bool settle();

  const AssociationProblem& problem_;
  Hypothesis hypothesis_;  ///< poses and objective after the last optimisation
  int first_;
  double fixed_ = 0.0;                  ///< part of the objective outside the field
  std::optional<GaussianField> field_;  ///< linearised at these poses; empty: not yet needed
  MapField* map_field_ = nullptr;       ///< of the current hypothesis; answers what it can
};

}  // namespace adit
