// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/bayes_tree.hpp"
#include "common/pose_graph/pose_graph.hpp"

namespace adit {

/// The Gaussian Markov random field of a pose graph that grows (see GaussianField): nodes and
/// constraints are added and removed, and nodes linearised again, at the cost of the part of the
/// Bayes tree that they touch. A node is linearised where it was last moved to.
///
/// Changes take effect with `update`. Node 0 is fixed in the map frame.
class IncrementalField {
 public:
  /// Poses keep their values where what they depend on changes by less than `unchanged` [m, rad].
  explicit IncrementalField(double unchanged) : tree_(3, unchanged) {}

  /// Adds a node at this pose; returns its index.
  int add_node(const Pose2& T_map_node);
  /// Removes the newest node, after all of its constraints.
  void remove_newest_node();
  [[nodiscard]] int nodes() const { return static_cast<int>(poses_.size()); }

  /// Adds a constraint; returns an id.
  int add(const PoseConstraint& constraint);
  void remove(int id);
  [[nodiscard]] const PoseConstraint& constraint(int id) const {
    return constraints_[static_cast<std::size_t>(id)];
  }

  /// Linearises a node at this pose.
  void move(int node, const Pose2& T_map_node);

  /// `only_new_nodes`: nodes alone were added, each with one constraint. Throws std::runtime_error
  /// if the constraints do not determine all poses.
  void update(bool only_new_nodes = false);

  /// T_map_node at the mode.
  [[nodiscard]] Pose2 pose(int node) const;
  /// The pose at which a node is linearised, and its change by the mode (x [m], y [m], θ [rad]).
  [[nodiscard]] const Pose2& linearisation_point(int node) const {
    return poses_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Eigen::Vector3d mode(int node) const;
  /// The nodes whose mode the last update changed, ascending.
  [[nodiscard]] std::vector<int> changed() const;
  /// Σ eᵀ R e of the linearised field at its mode.
  [[nodiscard]] double objective() const;

  /// Increase of `objective` if the constraint were added, see GaussianField.
  [[nodiscard]] double objective_increase(const PoseConstraint& constraint) const;
  /// Covariance of the relative pose that a constraint measures.
  [[nodiscard]] Eigen::Matrix3d predicted_covariance(const PoseConstraint& constraint) const;
  /// Covariance of (x, y, θ) of the pose of `to` in the frame of `from`, expressed in that frame.
  [[nodiscard]] Eigen::Matrix3d relative_covariance(int from, int to) const;

  /// How the mode of a node follows an error of the measurement of a constraint: from (x, y, θ) of
  /// the error, in the frame of the measurement, to that of the node in node 0, in the frame of
  /// that. The sum of K R⁻¹ Kᵀ over all constraints is the covariance of the node.
  [[nodiscard]] Eigen::Matrix3d response(int node, int id) const;

  [[nodiscard]] const BayesTree& tree() const { return tree_; }

 private:
  [[nodiscard]] BayesTree::Term term_of(const PoseConstraint& constraint);
  void linearise(int id);
  [[nodiscard]] Eigen::Matrix3d covariance(int from, int to, const LinearPotential& p) const;

  std::vector<Pose2> poses_;  // where each node is linearised
  std::vector<PoseConstraint> constraints_;
  std::vector<int> term_;         // of each constraint in the tree, or −1
  std::vector<double> constant_;  // of each constraint: eᵀ R e at the linearisation
  std::vector<int> free_;
  std::vector<std::vector<int>> constraints_of_;  // each node
  std::vector<int> stale_;                        // constraints to be linearised again
  double objective_at_linearisation_ = 0.0;
  BayesTree tree_;
};

}  // namespace adit
