// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A measured pose of one node in the frame of another: a potential of the Gaussian Markov random
/// field, H = eᵀ R e (paper, eq. 2). The paper writes the residual e in the global frame although R
/// belongs to a measurement in the frame of a node; here, as in g2o, it is taken in the measurement
/// frame: e = T_from_to⁻¹ · (T_map_from⁻¹ · T_map_to) as (x, y, θ).
struct PoseConstraint {
  int from = 0;  ///< index into PoseGraph::poses
  int to = 0;
  Pose2 T_from_to;
  /// Inverse covariance of e [1/m², 1/(m rad), 1/rad²].
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/// Poses and the constraints between them.
struct PoseGraph {
  std::vector<Pose2> poses;  ///< T_map_node
  std::vector<PoseConstraint> constraints;
};

/// The residual of a constraint, (x, y, θ) in the measurement frame: e = T_from_to⁻¹ ·
/// (T_map_from⁻¹ · T_map_to). The paper's eq. 3 is the same difference in the global frame; see
/// PoseConstraint.
Eigen::Vector3d residual(const PoseConstraint& constraint, const Pose2& T_map_from,
                         const Pose2& T_map_to);

/// The exponent of the potential, eᵀ R e (paper, eq. 2). The sum over a graph is the objective, as
/// in g2o without the factor ½.
double energy(const PoseConstraint& constraint, const Eigen::Vector3d& e);

/// The objective: the sum of all energies.
double objective(const PoseGraph& graph);

/// A potential to first order in small changes (δx, δy, δθ) of both poses, added to them in the map
/// frame: e(ξ_from + δ_from, ξ_to + δ_to) ≈ e + J_to · (δ_to − M · δ_from).
///
/// The paper's eq. 5 gives these derivatives for the residual in the global frame (with θ_k printed
/// in place of θ_j, and with the signs of its eq. 1). Here they are derived in the measurement
/// frame. With α = θ_from + θ of the measurement and d = t_to − t_from,
///   J_to = diag(R(α)ᵀ, 1),  M = [I, S d; 0, 1],  S = [0, −1; 1, 0]:
/// a rotation of `from` moves `to` along with it.
struct LinearPotential {
  Eigen::Vector3d e;      ///< the residual
  Eigen::Matrix3d J_to;   ///< ∂e/∂ξ_to
  Eigen::Vector2d lever;  ///< S d [m]

  /// ∂e/∂ξ_from = −J_to · M.
  [[nodiscard]] Eigen::Matrix3d jacobian_from() const;
};

/// Linearises a constraint at the given poses.
LinearPotential linearise(const PoseConstraint& constraint, const Pose2& T_map_from,
                          const Pose2& T_map_to);

}  // namespace adit
