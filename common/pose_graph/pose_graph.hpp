// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A measured pose of one node in the frame of another: a potential of the Gaussian Markov random
/// field, H = eᵀ R e (paper, eq. 2). The paper writes the residual e in the global frame although R
/// belongs to a measurement made in the frame of a node; here, as in g2o, it is taken where it was
/// measured: e = T_from_to⁻¹ · (T_map_from⁻¹ · T_map_to) as (x, y, θ).
struct PoseConstraint {
  int from = 0;  ///< index into PoseGraph::poses
  int to = 0;
  Pose2 T_from_to;
  /// Inverse covariance of e [1/m², 1/(m rad), 1/rad²].
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/// Poses and what was measured between them.
struct PoseGraph {
  std::vector<Pose2> poses;  ///< T_map_node
  std::vector<PoseConstraint> constraints;
};

}  // namespace adit
