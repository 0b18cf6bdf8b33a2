// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/normal_equations.hpp"

namespace adit {

/// The Gaussian Markov random field of a pose graph at a fixed linearisation (paper, section 2.3),
/// to evaluate data associations: constraints are added and removed at the cost of a few columns of
/// the factor, and the field gives their cost and the covariances of relative poses. All results
/// are to first order around the linearisation point; after a change that bends the map, optimise
/// the graph and construct a new field.
class GaussianField {
 public:
  /// Linearises at the poses of the graph. Throws std::runtime_error if the graph is not connected
  /// or does not determine all poses.
  explicit GaussianField(const PoseGraph& graph);

  /// Adds a constraint by a rank-3 update of the factor. It may link any two nodes of the graph.
  void add(const PoseConstraint& constraint);
  /// Removes a constraint of the graph or an added one. False, with the field unchanged, if the
  /// others do not determine all poses.
  [[nodiscard]] bool remove(const PoseConstraint& constraint);

  /// The mode as a change (x, y, θ per node except node 0), added to the poses in the map frame.
  [[nodiscard]] const Eigen::VectorXd& mode() const;
  /// T_map_node at the mode.
  [[nodiscard]] std::vector<Pose2> poses() const;
  /// Σ eᵀ R e of the linearised field at its mode.
  [[nodiscard]] double objective() const;

  /// Increase of `objective` if the constraint were added: dᵀ (Σ + R⁻¹)⁻¹ d, the squared
  /// Mahalanobis distance, where d is its residual at the mode and Σ the covariance of the measured
  /// relative pose. With R of full rank it is chi-square with three degrees of freedom if the
  /// constraint is correct.
  [[nodiscard]] double objective_increase(const PoseConstraint& constraint) const;

  /// The covariance Σ as above: that of the relative pose which the constraint measures, in the
  /// field as it is.
  [[nodiscard]] Eigen::Matrix3d predicted_covariance(const PoseConstraint& constraint) const;

  /// The field without one of its constraints.
  struct LeaveOneOut {
    double objective_decrease = 0.0;  ///< of `objective`
    double increase = 0.0;            ///< `objective_increase` of the query then
  };
  /// For each of `present`, constraints of the field, the effect of removing it alone; exact for
  /// the linearised field. Costs one column of the factor for all of them, and one path of the
  /// elimination tree for each, or one recursion for many; cached until the field changes.
  [[nodiscard]] std::vector<LeaveOneOut> leave_one_out(const std::vector<PoseConstraint>& present,
                                                       const PoseConstraint& query) const;

  /// For each of `present`, constraints of the field, the shift of the residual of `query` by the
  /// residual of that constraint, in standard deviations of `query`: how much its removal may
  /// matter. Costs one column of the factor for all of them.
  [[nodiscard]] std::vector<double> couplings(const std::vector<PoseConstraint>& present,
                                              const PoseConstraint& query) const;

  /// Covariance of (x, y, θ) of the pose of `to` in the frame of `from`, small motions of `to`
  /// expressed in the frame of `from`: for T_from_to = T_map_from⁻¹ · T_map_to to first order.
  [[nodiscard]] Eigen::Matrix3d relative_covariance(int from, int to) const;
  /// relative_covariance(i, to) for all i; zero for i = to.
  [[nodiscard]] std::vector<Eigen::Matrix3d> relative_covariances_to(int to) const;

 private:
  struct ConstraintView;

  [[nodiscard]] ConstraintView view_of(const PoseConstraint& constraint) const;
  [[nodiscard]] Eigen::MatrixXd columns_of(const ConstraintView& view) const;
  [[nodiscard]] Eigen::Matrix3d covariance_of(const ConstraintView& view,
                                              const PoseConstraint& constraint) const;
  [[nodiscard]] const Pose2& pose(int node) const;
  [[nodiscard]] LinearPotential linear(const PoseConstraint& constraint) const;
  void find_all_among(const std::vector<PoseConstraint>& present) const;
  void change_sums(const PoseConstraint& constraint, const LinearPotential& potential, double sign);

  std::vector<Pose2> poses_;  // the linearisation point
  NormalEquations equations_;
  Eigen::VectorXd b_;
  double objective_at_linearisation_ = 0.0;
  bool was_changed_ = false;  // since the factorisation
  // Computed on demand, invalidated when the field changes.
  mutable Eigen::VectorXd mode_;
  mutable std::vector<Eigen::Matrix3d> marginals_;
  mutable std::map<std::array<int, 2>, Eigen::MatrixXd> among_;
};

}  // namespace adit
