// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tools/survey/compare/surveyed_cloud.hpp"

namespace adit {

/// Where a 3D scan of the newer survey is in the older one.
struct ScanPlacement {
  /// Of points from the laser of the scan, along the axes of comparison, in comparison.
  Eigen::Isometry3d T_comparison_scan = Eigen::Isometry3d::Identity();
  /// Of small motions about the laser, relative to the older survey around it: (x, y, z [m],
  /// rotation vector [rad]).
  Matrix6d covariance = Matrix6d::Zero();
  bool registered = false;  ///< by the clouds; otherwise by its neighbours or the coordinates
  bool disagreed = false;   ///< its registration with those of its neighbours
  double moved_m = 0.0;     ///< by the registration, from the coordinates
  /// That motion over what both surveys state of their accuracy: chi-square of six degrees of
  /// freedom.
  double chi2 = 0.0;

  [[nodiscard]] Eigen::Vector3d laser() const { return T_comparison_scan.translation(); }
  /// Variance of a point along a unit vector [m²].
  [[nodiscard]] double variance_along(const Eigen::Vector3d& p_comparison,
                                      const Eigen::Vector3d& n) const;
};

/// The same by a covariance about a laser.
double variance_along(const Matrix6d& covariance, const Eigen::Vector3d& from_laser,
                      const Eigen::Vector3d& n);

/// All scans by their coordinates.
std::vector<ScanPlacement> placed_by_coordinates(const SurveyedCloud& newer);

/// Each scan registered to what the older survey shows around it (register_clouds, with a robust
/// kernel: surfaces that changed do not count while others are the majority), with the coordinates
/// and their covariances as a prior; then all of them adjusted together (adjust_placements), so
/// that a scan that follows a large surface which has moved is held by its neighbours. The drift of
/// both missions drops out, and with it any motion of a stretch of the mine that is longer than a
/// few scans, which `chi2` shows. Scans are registered in their order, each from the correction of
/// the nearest registered one; one that disagrees with the others once more, from where they put
/// it. A scan without enough in common stays where its neighbours put it.
std::vector<ScanPlacement> registered_scans(const SurveyedCloud& newer, const SurveyedCloud& older,
                                            const std::function<void(double done)>& progress);

}  // namespace adit
