// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"

namespace adit {

struct DegeneracyParams {
  double spurious_ratio = 4.0;  ///< information below this many times its spurious part is none
  double sd_max_m = 0.1;        ///< nor is information that leaves an uncertainty above this

  template <class V>
  void visit(V& v) {
    v("spurious_ratio", spurious_ratio, within(0.0, 1000.0));
    v("sd_max_m", sd_max_m, within(1e-3, 100.0));
  }
};

/// A direction that a match leaves open.
struct UnconstrainedDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit; x [m], y [m], θ [rad] · lever arm
  /// What may be left of the information when twice the feigned part is taken off [1/m²].
  double information = 0.0;
};

/// The information of a match, split into what it says and the directions in which it says nothing.
struct ConstrainedInformation {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< without the degenerate directions
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();   ///< its inverse in the other directions
  std::vector<UnconstrainedDirection> degenerate;
};

/// Looks at the information matrix of (x, y, θ) along its principal directions, angles being turned
/// into lengths by the lever arm. A direction is degenerate if what is known of it does not exceed
/// what the uncertainty of the surface normals (`spurious`) would feign, or leaves it uncertain by
/// more than `sd_max_m`: along a straight drift all walls are parallel to the way, and their
/// normals, which are measured, are never exactly so. (The idea of judging by eigenvalues: Censi,
/// "On achievable accuracy for range-finder localization", ICRA 2007; Zhang, Kaess, Singh, "On
/// degeneracy of optimization-based state estimation problems", ICRA 2016.)
ConstrainedInformation split_degenerate(const Eigen::Matrix3d& information,
                                        const Eigen::Matrix3d& spurious, double lever_arm_m,
                                        const DegeneracyParams& params);

}  // namespace adit
