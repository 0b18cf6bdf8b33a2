// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/normal_equations.hpp"

namespace adit {

/// The Gaussian Markov random field of a pose graph at a fixed linearisation, for trying data
/// associations: constraints come and go for a few columns of the factor each, and the field says
/// what they would cost and how uncertain a relative pose is. Everything holds to first order
/// around the linearisation point; after a change that bends the map, optimise and begin a new
/// field.
class GaussianField {
 public:
  /// Linearised at the poses of the graph, which is connected and determines all poses: throws
  /// std::runtime_error if not.
  explicit GaussianField(const PoseGraph& graph);

  /// Rank-3 update of the factor. The constraint may link any two nodes of the graph.
  void add(const PoseConstraint& constraint);
  /// Takes out a constraint of the graph or one that was added. False, and the field is as it was:
  /// the others do not determine all poses.
  [[nodiscard]] bool remove(const PoseConstraint& constraint);

  /// Where the mode is, as a change (x, y, θ per node but node 0) added to the poses in the map
  /// frame.
  [[nodiscard]] const Eigen::VectorXd& mode() const;
  /// T_map_node at the mode.
  [[nodiscard]] std::vector<Pose2> poses() const;
  /// Σ eᵀ R e of the linearised field at its mode.
  [[nodiscard]] double objective() const;

  /// By how much `objective` would rise if the constraint were added: dᵀ (Σ + R⁻¹)⁻¹ d, the squared
  /// Mahalanobis distance, where d is its residual at the mode and Σ the covariance of what it
  /// measures. With R of full rank it is chi-square with three degrees of freedom where the
  /// constraint is right.
  [[nodiscard]] double objective_increase(const PoseConstraint& constraint) const;

  /// What the field would be without one of its constraints.
  struct LeaveOneOut {
    double objective_decrease = 0.0;  ///< of `objective`
    double increase = 0.0;  ///< what `objective_increase` of the asked constraint would be
  };
  /// For each of `present`, constraints of the field, if it alone were removed; exact for the
  /// linearised field. Costs one column of the factor for all of them, and a look at a path of the
  /// elimination tree for each, once for as long as the field stays as it is.
  [[nodiscard]] std::vector<LeaveOneOut> leave_one_out(const std::vector<PoseConstraint>& present,
                                                       const PoseConstraint& query) const;

  /// Covariance of (x, y, θ) of the pose of `to` in the frame of `from`, small motions of `to`
  /// being expressed in the frame of `from`: for T_from_to = T_map_from⁻¹ · T_map_to to first
  /// order.
  [[nodiscard]] Eigen::Matrix3d relative_covariance(int from, int to) const;
  /// relative_covariance(i, to) for all i at once; zero for i = to.
  [[nodiscard]] std::vector<Eigen::Matrix3d> relative_covariances_to(int to) const;

 private:
  struct ConstraintView;

  [[nodiscard]] ConstraintView view_of(const PoseConstraint& constraint) const;
  [[nodiscard]] const Pose2& pose(int node) const;
  [[nodiscard]] LinearPotential linear(const PoseConstraint& constraint) const;
  void change_sums(const PoseConstraint& constraint, const LinearPotential& potential, double sign);

  std::vector<Pose2> poses_;  // the linearisation point
  NormalEquations equations_;
  Eigen::VectorXd b_;
  double objective_at_linearisation_ = 0.0;
  // Found when they are asked for, forgotten when the field changes.
  mutable Eigen::VectorXd mode_;
  mutable std::vector<Eigen::Matrix3d> marginals_;
  mutable std::map<std::array<int, 2>, Eigen::MatrixXd> among_;
};

}  // namespace adit
