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
  /// Signed distance travelled forwards in a session, along which its constant error of the pitch
  /// adds up in `climb_m`; negative where it is subtracted, 0 where nothing was integrated.
  struct Travel {
    int session = 0;
    double forward_m = 0.0;
  };
  std::array<Travel, 2> travels{};
};

/// What is known of the constant error of the pitch of a session from elsewhere [rad], positive if
/// the body seems to climb.
struct PitchPrior {
  double error_rad = 0.0;
  double sd_rad = 0.005;
};

/// Heights of the nodes of a pose graph: a linear Gaussian Markov random field on the same graph,
/// kept up to date at the cost of what changes (see BayesTree). Unknown are the height of each node
/// except node 0, which is 0, and for each session a constant error of the pitch, as that of the
/// accelerometer's bias and of the mount.
class HeightField {
 public:
  /// A field of a single node. `pitch_sd_rad`: prior standard deviation of the pitch errors. Nodes
  /// without a constraint have height 0 with a standard deviation of 1 km.
  explicit HeightField(double pitch_sd_rad);
  HeightField(int nodes, const std::vector<HeightConstraint>& constraints, double pitch_sd_rad);

  /// Changes take effect with `update`. A node is removed after its constraints; an id that `add`
  /// returned names a constraint until it is removed.
  void add_node();
  void remove_newest_node();
  int add(const HeightConstraint& constraint);
  void remove(int id) { tree_.remove_term(id); }
  /// Replaces the prior of the pitch error of a session, which may have no constraint yet.
  void set_pitch_prior(int session, const PitchPrior& prior);
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
  /// An unknown: its block in the tree, and the term of its prior.
  struct Unknown {
    int block = 0;
    int prior = 0;
  };

  [[nodiscard]] Unknown add_unknown(double mean, double sd, bool of_session);
  [[nodiscard]] int add_prior(int block, double mean, double sd);
  [[nodiscard]] int block_of(int node) const {
    return nodes_[static_cast<std::size_t>(node) - 1].block;
  }

  double pitch_sd_rad_;
  BayesTree tree_;
  std::vector<Unknown> nodes_;              // from node 1 on
  std::vector<Unknown> pitch_;              // of each session
  std::map<int, PitchPrior> pitch_priors_;  // by session, otherwise pitch_sd_rad_
};

}  // namespace adit
