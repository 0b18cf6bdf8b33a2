// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"

namespace adit {

struct DegeneracyParams {
  /// Information below this multiple of its spurious part is discarded.
  double spurious_ratio = 4.0;
  double sd_max_m = 0.1;  ///< as is information that leaves a larger standard deviation

  template <class V>
  void visit(V& v) {
    v("spurious_ratio", spurious_ratio, within(0.0, 1000.0));
    v("sd_max_m", sd_max_m, within(1e-3, 100.0));
  }
};

/// A direction that a match does not constrain.
struct UnconstrainedDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit; x [m], y [m], θ [rad] · lever arm
  /// Lower estimate of the information in it: what remains after twice the spurious part is
  /// subtracted [1/m²].
  double information = 0.0;
};

/// The information of a match, split into the constrained subspace and the degenerate directions.
struct ConstrainedInformation {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the constrained directions
  /// Its inverse in the constrained directions.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::vector<UnconstrainedDirection> degenerate;
};

/// Decomposes the information matrix of (x, y, θ) along its principal directions, with angles
/// converted to lengths by the lever arm. A direction is degenerate if its information does not
/// exceed what the uncertainty of the surface normals alone produces (`spurious`), or leaves a
/// standard deviation above `sd_max_m`: in a straight tunnel all walls are parallel to the axis,
/// but their measured normals are never exactly parallel. (Degeneracy by eigenvalues: Censi, "On
/// achievable accuracy for range-finder localization", ICRA 2007; Zhang, Kaess, Singh, "On
/// degeneracy of optimization-based state estimation problems", ICRA 2016.)
ConstrainedInformation split_degenerate(const Eigen::Matrix3d& information,
                                        const Eigen::Matrix3d& spurious, double lever_arm_m,
                                        const DegeneracyParams& params);

}  // namespace adit
