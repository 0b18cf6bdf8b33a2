// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "common/pose_graph/sparse_cholesky.hpp"

namespace adit {

/// The links of a graph and the resulting order of elimination: all that depends neither on poses
/// nor on measurements. Pose 0 is fixed (relative measurements do not determine where the complete
/// graph lies), so that node i is block i − 1.
struct GraphStructure {
  BlockPattern pattern;
  BlockOrdering ordering;
  std::vector<int> pair_of_constraint;  ///< in the pattern, or −1 for a constraint with pose 0
};

/// Symbolic analysis. The graph has at least two poses.
GraphStructure analyse(const PoseGraph& graph);

/// The first node that no chain of constraints links with node 0, if any.
std::optional<int> first_unconnected_node(const PoseGraph& graph);

/// Offset of a node (other than node 0) in δ.
inline Eigen::Index row_of(int node) { return Eigen::Index{3} * (node - 1); }

/// The field linearised around the poses of a graph, H δ = b with H = Σ Jᵀ R J and b = −Σ Jᵀ R e
/// (paper, section 2.3, after eq. 5). δ holds three entries (x [m], y [m], θ [rad]) for each node
/// except node 0, which are added to its pose in the map frame.
class NormalEquations {
 public:
  explicit NormalEquations(const GraphStructure& structure);

  /// Computes H and b; returns the objective. The graph has the analysed structure.
  double linearise(const PoseGraph& graph);
  /// The same with the measured lever arm of each constraint instead of that of the poses: correct
  /// to first order if only the orientations of the poses are known.
  double linearise_at_measurements(const PoseGraph& graph);
  /// The same with a share, 0 to 1, of the curvature of the residuals: H = Σ (Jᵀ R J + share · Σ_k
  /// (R e)_k ∂²e_k), half the second derivative of the objective for share 1, as Newton's method
  /// requires. H may be indefinite away from a minimum.
  double linearise_with_curvature(const PoseGraph& graph, double share);
  /// Computes b only; returns the objective.
  double linearise_gradient(const PoseGraph& graph);

  [[nodiscard]] SparseCholesky& matrix() { return H_; }
  [[nodiscard]] const SparseCholesky& matrix() const { return H_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }

 private:
  enum class Matrix { kFirstOrder, kAtMeasurements, kSecondOrder };
  template <Matrix kMatrix>
  double accumulate(const PoseGraph& graph);
  void add_to_matrix(const PoseConstraint& constraint, int pair, const LinearPotential& potential);
  void add_curvature(const PoseConstraint& constraint, int pair, const LinearPotential& potential,
                     const Eigen::Vector3d& weighted);

  std::vector<int> pair_of_constraint_;
  double curvature_share_ = 0.0;
  SparseCholesky H_;
  Eigen::VectorXd b_;
};

/// Blocks of Jᵀ R J of a constraint.
struct ConstraintHessian {
  Eigen::Matrix3d from;     ///< at (from, from)
  Eigen::Matrix3d from_to;  ///< at (from, to)
  Eigen::Matrix3d to;       ///< at (to, to)
};
ConstraintHessian hessian(const PoseConstraint& constraint, const LinearPotential& potential);

/// b = −Σ Jᵀ R e of a graph, with rows as in NormalEquations; returns the objective.
double gradient(const PoseGraph& graph, Eigen::VectorXd& b);

/// Adds δ to the poses.
void move_poses(const Eigen::VectorXd& delta, std::vector<Pose2>& poses);

}  // namespace adit
