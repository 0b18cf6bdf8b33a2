// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/pose_graph/pose_graph.hpp"
#include "common/pose_graph/sparse_cholesky.hpp"

namespace adit {

/// Who is linked with whom, and the order of elimination that follows: all that depends on neither
/// poses nor measurements. Pose 0 is held fixed (a field of relative measurements says nothing of
/// where the whole lies), so that node i is block i − 1.
struct GraphStructure {
  BlockPattern pattern;
  BlockOrdering ordering;
  std::vector<int> pair_of_constraint;  ///< in the pattern, or −1 if it is with pose 0
};

/// One symbolic analysis. The graph has at least two poses.
GraphStructure analyse(const PoseGraph& graph);

/// The first node that no chain of constraints links with node 0.
std::optional<int> first_unconnected_node(const PoseGraph& graph);

/// Where a node (other than node 0) begins among the entries of δ.
inline Eigen::Index row_of(int node) { return Eigen::Index{3} * (node - 1); }

/// The field linearised around the poses of a graph, H δ = b with H = Σ Jᵀ R J and b = −Σ Jᵀ R e
/// (paper, after eq. 5: the Gaussian Markov random field whose mode is sought). δ holds three
/// entries (x [m], y [m], θ [rad]) for each node but node 0, which are added to its pose in the map
/// frame.
class NormalEquations {
 public:
  explicit NormalEquations(const GraphStructure& structure);

  /// H and b from scratch; returns the objective. The graph has the structure that was analysed.
  double linearise(const PoseGraph& graph);
  /// The same with the lever arm of each constraint as it was measured instead of as the poses have
  /// it: right to first order around poses of which only the orientations are known.
  double linearise_at_measurements(const PoseGraph& graph);
  /// b alone, H stays; returns the objective.
  double linearise_gradient(const PoseGraph& graph);

  [[nodiscard]] SparseCholesky& matrix() { return H_; }
  [[nodiscard]] const SparseCholesky& matrix() const { return H_; }
  [[nodiscard]] const Eigen::VectorXd& b() const { return b_; }

 private:
  template <bool kMatrix, bool kAtMeasurements>
  double accumulate(const PoseGraph& graph);
  void add_to_matrix(const PoseConstraint& constraint, int pair, const LinearPotential& potential);
  void add_to_b(const PoseConstraint& constraint, const LinearPotential& potential,
                const Eigen::Vector3d& weighted);

  std::vector<int> pair_of_constraint_;
  SparseCholesky H_;
  Eigen::VectorXd b_;
};

/// The poses moved by δ.
void move_poses(const Eigen::VectorXd& delta, std::vector<Pose2>& poses);

}  // namespace adit
