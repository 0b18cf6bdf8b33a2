// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/bayes_tree.hpp"

namespace adit {

/// A measured difference of the heights of two nodes.
struct HeightConstraint {
  int from = 0;
  int to = 0;
  double climb_m = 0.0;  ///< height of `to` above `from`
  double sd_m = 1.0;
  /// Signed distance in a session, forwards and to the left in the body frame, along which its
  /// constant error of the attitude adds up in `climb_m`: travelled, or seen across; negative where
  /// it is subtracted, 0 where nothing was integrated.
  struct Travel {
    int session = 0;
    double forward_m = 0.0;
    double left_m = 0.0;
  };
  std::array<Travel, 2> travels{};
};

/// What is known of the constant error of the attitude of a session from elsewhere: of the pitch,
/// positive if the body seems to climb, and of the roll, positive if its left side seems high.
struct TiltPrior {
  Eigen::Vector2d error_rad = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = 0.005 * 0.005 * Eigen::Matrix2d::Identity();  ///< [rad²]
};

/// Heights of the nodes of a pose graph: a linear Gaussian Markov random field on the same graph,
/// kept up to date at the cost of what changes (see BayesTree). Unknown are the height of each node
/// except node 0, which is 0, and for each session a constant error of pitch and roll, as that of
/// the accelerometer's bias and of the mount.
class HeightField {
 public:
  /// A field of a single node. `tilt_sd_rad`: prior standard deviation of pitch and roll errors.
  /// Nodes without a constraint have height 0 with a standard deviation of 1 km.
  explicit HeightField(double tilt_sd_rad);
  HeightField(int nodes, const std::vector<HeightConstraint>& constraints, double tilt_sd_rad);

  /// Changes take effect with `update`. A node is removed after its constraints; an id that `add`
  /// returned names a constraint until it is removed.
  int add_node();  ///< returns its index
  void remove_newest_node();
  int add(const HeightConstraint& constraint);
  void remove(int id) { tree_.remove_term(id); }
  /// Replaces the prior of the attitude error of a session, which may have no constraint yet.
  void set_tilt_prior(int session, const TiltPrior& prior);
  void update();

  [[nodiscard]] int nodes() const { return static_cast<int>(nodes_.size()) + 1; }
  /// Height of a node above node 0 [m].
  [[nodiscard]] double height_m(int node) const;
  /// Variance of the height of `to` above `from` [m²]; costs their paths in the tree.
  [[nodiscard]] double variance(int from, int to) const;
  /// Of all nodes above `node`.
  [[nodiscard]] Eigen::VectorXd variances_to(int node) const;
  /// Estimated pitch error of a session [rad].
  [[nodiscard]] double pitch_error_rad(int session) const;

 private:
  /// The block of a height in the tree, and the term of its prior.
  struct Node {
    int block = 0;
    int prior = 0;
  };
  /// The blocks of the pitch and roll errors of a session, and the term of their prior.
  struct Tilt {
    int pitch = 0;
    int roll = 0;
    int prior = 0;
  };

  [[nodiscard]] const Tilt& tilt_of(int session);
  [[nodiscard]] int add_prior(const Tilt& tilt, const TiltPrior& prior);
  [[nodiscard]] int block_of(int node) const {
    return nodes_[static_cast<std::size_t>(node) - 1].block;
  }

  double tilt_sd_rad_;
  BayesTree tree_;
  std::vector<Node> nodes_;               // from node 1 on
  std::vector<Tilt> tilts_;               // of each session
  std::map<int, TiltPrior> tilt_priors_;  // by session, otherwise tilt_sd_rad_
};

}  // namespace adit
