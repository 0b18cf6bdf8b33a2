// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

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
/// solved exactly. Unknown are the height of each node except node 0, which is 0, and for each
/// session a constant error of the pitch, as that of the accelerometer's bias and of the mount.
class HeightField {
 public:
  /// An empty field of a single node.
  HeightField();
  /// `pitch_prior`: of the pitch error of a session. Nodes without a constraint have
  /// height 0 with a standard deviation of 1 km.
  HeightField(int nodes, const std::vector<HeightConstraint>& constraints,
              const std::function<PitchPrior(int session)>& pitch_prior);
  ~HeightField();
  HeightField(HeightField&&) noexcept;
  HeightField& operator=(HeightField&&) noexcept;

  [[nodiscard]] int nodes() const { return nodes_; }
  /// Height of a node above node 0 [m].
  [[nodiscard]] double height_m(int node) const;
  /// Variance of the height of `to` above `from` [m²]; costs one solution with the factor.
  [[nodiscard]] double variance(int from, int to) const;
  /// Of all nodes above `node`.
  [[nodiscard]] Eigen::VectorXd variances_to(int node) const;
  /// Estimated pitch error of a session [rad].
  [[nodiscard]] double pitch_error_rad(int session) const;

 private:
  struct Factor;

  int nodes_ = 1;
  Eigen::VectorXd solution_;  ///< heights of nodes 1 .., then pitch errors
  std::unique_ptr<Factor> factor_;
};

}  // namespace adit
