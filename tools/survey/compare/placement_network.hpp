// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/motion3.hpp"

namespace adit {

/// What is known of the motion by which a 3D scan of the newer survey is to be moved from its
/// coordinates. Motions are small ones about the laser of the scan along the axes of comparison:
/// (x, y, z [m], rotation vector [rad]); covariances and information are theirs.
struct ObservedPlacement {
  Eigen::Vector3d laser{0.0, 0.0, 0.0};  ///< by the coordinates, in comparison [m]
  Vector6d registered = Vector6d::Zero();
  Matrix6d information = Matrix6d::Zero();            ///< of the registration; zero without one
  Matrix6d prior_information = Matrix6d::Identity();  ///< of the coordinates, about no motion
  /// Of the place relative to the scan before, by both surveys; of the first scan unused.
  Matrix6d step_covariance = Matrix6d::Identity();
};

struct AdjustedPlacement {
  Vector6d motion = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
  /// Of the registration from the motion that the other scans give: chi-square of six degrees of
  /// freedom; zero without a registration.
  double chi2 = 0.0;
  /// Whether the registration agrees with those of the other scans. One that does not is not used.
  bool agrees = false;
};

/// Adjusts all scans together: the registration of each, its coordinates, and the steps from scan
/// to scan, which both surveys know better than their coordinates. A scan before a large surface
/// that has moved follows that surface, while its neighbours do not: the steps tell. Least squares
/// with a Geman-McClure kernel on the registrations, from stiff steps to the stated ones (graduated
/// non-convexity: Yang, Antonante, Tzoumas, Carlone, "Graduated non-convexity for robust spatial
/// perception", RA-L 2020, section IV), as a chain, in a time linear in the number of scans.
std::vector<AdjustedPlacement> adjust_placements(std::span<const ObservedPlacement> scans);

}  // namespace adit
